//! How much may the diameter change at a place?
//!
//! A rule or a user sets a greatest and a least diameter; the wall around a bore must stay; and with wood only taken
//! off, nothing is added. The limits hold along the whole curve: [`Limits::rows`] are places close together, and
//! [`Limits::broken`] checks between them.

pub use crate::aim::incline::Room;
use crate::aim::incline::{Steepness, places};
use crate::aim::wish::{DiameterLimit, Wish};
use crate::engine::{Bat, Error, Profile, Result, SAME_PLACE, Section, golden, shown_length};

/// Distance between the places where the limits are checked first (m).
const EVERY: f64 = 5e-3;
/// Distance between places of a close check of the curve (m).
const CLOSE: f64 = 5e-4;
/// A limit that is violated by no more than this is kept (m).
pub const KEPT: f64 = 1e-9;
/// Least wall around a bore (m), where it is not thinner already.
const WALL: f64 = 1e-3;
/// Least diameter of a solid bat (m), and, where it is thinner already as at the point of a tip, the share of its
/// diameter that must remain.
const THINNEST: f64 = 5e-3;
const LEFT: f64 = 0.9;

/// The limits of a bat's diameter.
#[derive(Debug, Clone)]
pub struct Limits<'a> {
    bat: &'a Bat,
    remove_only: bool,
    /// Greatest diameter by the rules (m).
    rule: f64,
    stretches: Vec<DiameterLimit>,
    /// How steep the surface may become.
    steepness: Option<Steepness>,
}

/// A place where a curve breaks a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Broken {
    /// The allowed change there.
    pub room: Room,
    /// Amount by which it is too thick, or below 0 too thin (m).
    pub by: f64,
}

impl<'a> Limits<'a> {
    /// The limits of a wish on this bat.
    pub fn new(wish: &Wish, bat: &'a Bat) -> Self {
        let rule = wish.rules.as_ref().map_or(f64::INFINITY, |rules| rules.diameter());
        let steepness = wish.slope.map(|most| Steepness::new(most, wish.grid(bat)));
        let (remove_only, stretches) = (wish.remove_only, wish.diameter.clone());
        Self { bat, remove_only, rule, stretches, steepness }
    }

    /// These limits, applied to another bat.
    pub fn on<'b>(&self, bat: &'b Bat) -> Limits<'b>
    where
        'a: 'b,
    {
        Limits { bat, ..self.clone() }
    }

    /// Allowed change at `x`, where the bat has that section.
    pub fn room(&self, x: f64, section: Section) -> Room {
        let diameter = 2.0 * section.outer;
        let least = match section.inner > 0.0 {
            true => (2.0 * (section.inner + WALL)).min(diameter),
            false => THINNEST.min(LEFT * diameter),
        };
        let (mut low, mut high) = (least - diameter, self.rule - diameter);
        let same = SAME_PLACE * self.bat.length();
        for limit in self.stretches.iter().filter(|l| x >= l.from - same && x <= l.to + same) {
            low = low.max(limit.at_least.map_or(f64::NEG_INFINITY, |least| least - diameter));
            high = high.min(limit.at_most.map_or(f64::INFINITY, |most| most - diameter));
        }
        if self.remove_only {
            high = high.min(0.0);
        }
        Room { x, low, high }
    }

    /// Checks the limits where the bat may not change, at places given by `stays`.
    ///
    /// # Errors
    ///
    /// [`Error::Value`] about a limit that the bat violates where nothing may change it.
    pub fn check(&self, stays: impl Fn(f64) -> bool) -> Result<()> {
        for (k, limit) in self.stretches.iter().enumerate() {
            self.check_stretch(k, limit)?;
        }
        for room in self.rows(&|_| true) {
            let fixed = stays(room.x);
            let thick = room.high < -KEPT && fixed;
            let thin = room.low > KEPT && (fixed || self.remove_only);
            let narrow = room.low > room.high + KEPT;
            if !(thick || thin || narrow) {
                continue;
            }
            let here = 2.0 * self.bat.profile().at(room.x).outer;
            let at = shown_length(room.x);
            let found = format!("a bat {} across at {at}", shown_length(here));
            let (field, expected) = match (thin || narrow, self.blamed(room.x, thin)) {
                (true, Some(k)) if thin => (
                    format!("diameter[{k}].at_least"),
                    format!("at most that: {}", self.why(fixed)),
                ),
                (true, Some(k)) => (
                    format!("diameter[{k}]"),
                    "limits that leave something between them there".to_owned(),
                ),
                (_, Some(k)) if self.rule - here >= room.high => (
                    format!("diameter[{k}].at_most"),
                    format!("at least that: {}", self.why(fixed)),
                ),
                _ => (
                    "rules".to_owned(),
                    format!(
                        "at most {} across there, which stays as it is",
                        shown_length(self.rule)
                    ),
                ),
            };
            return Err(Error::value(field, found, expected));
        }
        Ok(())
    }

    /// The error that the limits leave no room at `x`, where the nearest smooth curve is too thick by `by` (m), too
    /// thin if negative.
    pub fn no_room(&self, x: f64, by: f64) -> Error {
        let at = shown_length(x);
        let here = 2.0 * self.bat.profile().at(x).outer;
        let field = match self.blamed(x, by < 0.0) {
            Some(k) => format!("diameter[{k}]"),
            None if by > 0.0 && self.rule.is_finite() => "rules".to_owned(),
            None => "diameter".to_owned(),
        };
        let found = format!(
            "limits that leave no room at {at}, where the bat is {} across",
            shown_length(here)
        );
        let side = if by > 0.0 { "thicker" } else { "thinner" };
        let expected = format!(
            "limits of the diameter that a smooth curve can keep: the nearest one is {} {side} there than they allow",
            shown_length(by.abs())
        );
        Error::value(field, found, expected)
    }

    fn why(&self, fixed: bool) -> &'static str {
        if fixed { "it stays as it is there" } else { "wood is only taken off" }
    }

    /// The number of the stretch whose limit binds at `x`.
    fn blamed(&self, x: f64, least: bool) -> Option<usize> {
        let here = self.stretches.iter().enumerate().filter(|(_, l)| x >= l.from && x <= l.to);
        let of = |limit: &DiameterLimit| {
            if least { limit.at_least } else { limit.at_most.map(|most| -most) }
        };
        let bound = here.filter_map(|(k, limit)| Some((k, of(limit)?)));
        bound.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    }

    fn check_stretch(&self, k: usize, limit: &DiameterLimit) -> Result<()> {
        let length = self.bat.length();
        let wrong = |found: String, expected: String| {
            Err(Error::value(format!("diameter[{k}]"), found, expected))
        };
        let beyond = |x: f64| x.is_finite() && x > length * (1.0 + SAME_PLACE);
        if beyond(limit.from) || beyond(limit.to) {
            let found = shown_length(if beyond(limit.to) { limit.to } else { limit.from });
            return wrong(found, format!("places on the bat, 0 to {}", shown_length(length)));
        }
        if let (Some(least), Some(most)) = (limit.at_least, limit.at_most)
            && least > most
        {
            let found =
                format!("at least {} and at most {}", shown_length(least), shown_length(most));
            return wrong(found, "limits that leave something between them".to_owned());
        }
        Ok(())
    }

    /// Allowed slopes of the change, at places where the bat may change; empty without a limit.
    pub fn inclines(&self, changes: &dyn Fn(f64) -> bool) -> Vec<Room> {
        self.steepness.map_or(vec![], |steepness| steepness.inclines(self.bat, changes))
    }

    /// Largest excess of the slope of another bat of the same length over the allowed one: radius over length.
    pub fn steeper_by(&self, other: &Bat) -> f64 {
        self.steepness.map_or(0.0, |steepness| steepness.broken_by(self.bat, other))
    }

    /// Reserves this much room below the limit of the slope, for rounded stations.
    pub fn gentler_by(&mut self, by: f64) {
        if let Some(steepness) = &mut self.steepness {
            steepness.ripple += by;
        }
    }

    /// The places where limits are checked first, among those where the bat may change; both sides of a step.
    pub fn rows(&self, changes: &dyn Fn(f64) -> bool) -> Vec<Room> {
        let mut rooms: Vec<Room> = vec![];
        for (piece, s, x) in places(self.bat, EVERY) {
            let room = self.room(x, piece.at(s));
            // Where two pieces meet without a step, once.
            if changes(x) && rooms.last() != Some(&room) {
                rooms.push(room);
            }
        }
        rooms
    }

    /// The places where a change of the diameter (m, by the place and a place on the same piece of the bat) violates a
    /// limit, one for each stretch, the worst; the curve may have corners only at `borders`.
    pub fn broken(&self, borders: &[f64], change: &dyn Fn(f64, f64) -> f64) -> Vec<Broken> {
        let profile = self.bat.profile();
        let mut places = profile.borders();
        places.extend(borders);
        places.retain(|x| (0.0..=profile.length()).contains(x));
        places.sort_by(f64::total_cmp);
        places.dedup_by(|a, b| (*a - *b).abs() <= SAME_PLACE * profile.length());
        let mut broken = vec![];
        for ends in places.windows(2) {
            let inside = 0.5 * (ends[0] + ends[1]);
            let at = |x: f64| {
                let room = self.room(x, section(profile, x, inside));
                let change = change(x, inside);
                let (over, under) = (change - room.high, room.low - change);
                let by = if over >= under { over } else { -under };
                (Broken { room, by }, over.max(under))
            };
            broken.extend(worst([ends[0], ends[1]], at));
        }
        broken
    }

    /// The places where a bat of the same length violates a limit.
    pub fn broken_by(&self, other: &Bat) -> Vec<Broken> {
        let (profile, new) = (self.bat.profile(), other.profile());
        let change = |x: f64, inside: f64| {
            2.0 * (section(new, x, inside).outer - section(profile, x, inside).outer)
        };
        self.broken(&new.borders(), &change)
    }
}

/// The section at `x`, of the piece that contains the place `inside`.
pub fn section(profile: &Profile, x: f64, inside: f64) -> Section {
    let piece = profile.piece_at(inside);
    piece.at(((x - piece.start) / piece.length).clamp(0.0, 1.0))
}

/// The worst places of a stretch: local maxima of the distance beyond the nearer limit (m, below 0 inside), each located
/// between the neighbouring places.
fn worst([from, to]: [f64; 2], at: impl Fn(f64) -> (Broken, f64)) -> Vec<Broken> {
    /// A place farther inside than this is not near a limit (m).
    const FAR: f64 = -1e-5;
    let count = ((to - from) / CLOSE).ceil().max(4.0) as usize;
    let place = |k: usize| from + (to - from) * k as f64 / count as f64;
    let seen: Vec<(Broken, f64)> = (0..=count).map(|k| at(place(k))).collect();
    let beyond =
        |k: Option<usize>| k.and_then(|k| seen.get(k)).map_or(f64::NEG_INFINITY, |seen| seen.1);
    let mut found = vec![];
    for (k, here) in seen.iter().enumerate() {
        let (before, value, after) = (beyond(k.checked_sub(1)), here.1, beyond(Some(k + 1)));
        let flat = before == value && value == after;
        if value < before || value < after || value < FAR || flat {
            continue;
        }
        let ends = [place(k.saturating_sub(1)), place((k + 1).min(count))];
        let near = at(golden::least(ends[0], ends[1], |x| -at(x).1));
        let (broken, beyond) = if near.1 > value { near } else { *here };
        found.extend((beyond > 0.5 * KEPT).then_some(broken));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cone() -> Bat {
        let text = r#"{ "format": "sweetspot-bat/1", "material": "white-ash",
            "profile": { "unit": "mm", "interpolation": "linear", "x": [0, 800], "diameter": [24, 64] } }"#;
        Bat::from_text("cone.json", text, "".as_ref()).unwrap()
    }

    fn wish(diameter: Vec<DiameterLimit>) -> Wish {
        Wish { remove_only: true, diameter, ..Wish::default() }
    }

    /// A bump between the places where limits are checked first is found to 1e-9 m.
    #[test]
    fn a_bump_of_a_nanometre_between_the_places_is_found() {
        let bat = cone();
        let limits = Limits::new(&wish(vec![]), &bat);
        let bump = |x: f64, _| 2e-9 - 1e-3 * (x - 0.3217).powi(2);
        let broken = limits.broken(&[], &bump);
        assert_eq!(broken.len(), 1, "{broken:?}");
        assert!((broken[0].by - 2e-9).abs() < 1e-12 && (broken[0].room.x - 0.3217).abs() < 1e-4);
        let thin = |x: f64, _| -1e-3 * (x - 0.3217).powi(2);
        assert!(limits.broken(&[], &thin).is_empty());
    }

    #[test]
    fn a_limit_above_the_bat_is_told() {
        let bat = cone();
        let limit = |from: f64, to: f64, at_least: f64| DiameterLimit {
            from,
            to,
            at_least: Some(at_least),
            at_most: None,
        };
        let said = |limit: DiameterLimit| {
            let wish = wish(vec![limit]);
            Limits::new(&wish, &bat).check(|_| false).map_err(|error| error.to_string())
        };
        assert_eq!(said(limit(0.1, 0.2, 0.025)), Ok(()));
        let above = said(limit(0.1, 0.2, 0.03)).unwrap_err();
        assert!(
            above.starts_with("diameter[0].at_least") && above.contains("taken off"),
            "{above}"
        );
        assert!(said(limit(0.1, 0.9, 0.02)).unwrap_err().contains("on the bat"));
    }
}
