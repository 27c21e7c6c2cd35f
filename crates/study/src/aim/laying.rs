//! Where are the stations of the changed bat?
//!
//! They are the bat's own stations, with unchanged digits where nothing changes, and further ones at even places where
//! the diameter changes.
//!
//! A curve through stations depends on two stations on both sides. At a domed tip, beside a stretch that is kept, or
//! between stations that are far apart, it would depart from the changed curve. There, stations are added halfway until
//! it does not. These have more digits, and so have the stations where the change ends.

use serde::Serialize;

use crate::aim::limits::{Limits, section};
use crate::aim::spline::Splines;
use crate::aim::wish::Grid;
use crate::engine::{Bat, Interpolation, Profile, Radii, Result, SAME_PLACE, Stations};

/// A station of the new bat.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, schemars::JsonSchema)]
pub struct Station {
    /// Its position (m).
    #[serde(rename = "x_m")]
    pub x: f64,
    /// Diameter that the bat had there (m).
    #[serde(rename = "old_m")]
    pub old: f64,
    /// Diameter of the new bat (m).
    #[serde(rename = "new_m")]
    pub new: f64,
    /// Diameter by the smooth change (m).
    #[serde(skip)]
    pub exact: f64,
    /// Inner radius (m).
    #[serde(skip)]
    pub(super) inner: f64,
    /// Least diameter that the limits allow (m); larger if the curve beside the station needs it.
    #[serde(skip)]
    pub(super) low: f64,
    /// Greatest diameter that the limits allow (m); smaller if the curve beside the station needs it.
    #[serde(skip)]
    pub(super) high: f64,
    /// Step to which its diameter is rounded (m).
    #[serde(skip)]
    pub(super) round: f64,
    /// Whether it is in a stretch that is kept.
    #[serde(skip)]
    pub(super) kept: bool,
}

/// A change of a bat's diameter for which stations are laid.
pub struct Laying<'a> {
    /// The bat before the change of its diameter.
    pub bat: &'a Bat,
    /// The limits of its diameter.
    pub limits: &'a Limits<'a>,
    /// The change (mm) and its basis curves, with places as shares of `stretch`.
    pub change: (&'a Splines, &'a [f64], f64),
    /// How stations are laid.
    pub grid: Grid,
}

/// The place of a new station (m), another place on the same piece of the bat, and the factor by which its diameter is
/// rounded finer than others.
#[derive(Debug, Clone, Copy)]
struct StationPlace {
    x: f64,
    inside: f64,
    finer: f64,
}

/// A place beside a station, as a share of the way to the next.
const BESIDE: f64 = 1e-6;
/// A change smaller than this share of the rounding does not count.
const NOTHING: f64 = 0.25;
/// Allowed distance of the curve through stations from the changed diameter, as a share of the rounding; where nothing
/// changes, allowed distance from the old one (m).
const BESIDE_CHANGED: f64 = 0.1;
const BESIDE_KEPT: f64 = 1e-6;
/// Least distance between two stations (m).
const CLOSEST: f64 = 5e-4;
/// Most rounds of adding stations: each changes the curve beside new stations.
const HALVINGS: usize = 40;
/// Stations closer than this share of the even distance are near: no even station is placed beside the bat's own, and
/// the diameters of both are rounded this many times finer.
const NEAR: f64 = 0.7;
const FINER: f64 = 10.0;

impl Laying<'_> {
    /// The change at a place (m of diameter): 0 where it is too small to be turned, and the full change from twice that
    /// on.
    fn change(&self, x: f64) -> f64 {
        let (splines, p, stretch) = self.change;
        if !self.is_free(x) {
            return 0.0;
        }
        let change = 1e-3 * splines.at(p, x / stretch);
        let large = 2.0 * (change.abs() - NOTHING * self.grid.round);
        large.clamp(0.0, change.abs()).copysign(change)
    }

    /// Whether a place may change.
    fn is_free(&self, x: f64) -> bool {
        let (splines, _, stretch) = self.change;
        let length = self.bat.length();
        let same = SAME_PLACE * length;
        splines.stretches.iter().any(|s| {
            let [from, to] = s.map(|end| end * stretch);
            (x > from + same || from <= same)
                && (x < to - same || to >= length - same)
                && x >= from - same
                && x <= to + same
        })
    }

    /// Whether a place is on the bat and in a stretch that stays.
    fn is_kept(&self, x: f64) -> bool {
        x >= 0.0 && x <= self.bat.length() && !self.is_free(x)
    }

    /// Whether the profile follows from its stations, so that they alone give the same curve.
    fn is_of_stations(&self) -> bool {
        self.bat.profile().formulas.is_none() && self.bat.edits().is_empty()
    }

    /// The stations, with the diameters they would have without rounding.
    ///
    /// # Errors
    ///
    /// Those of [`Profile::new`].
    pub fn stations(&self) -> Result<Vec<Station>> {
        let mut places = self.places();
        let stations = |places: &[StationPlace]| -> Vec<Station> {
            places.iter().map(|place| self.station(*place)).collect()
        };
        for _ in 0..HALVINGS {
            let laid = stations(&places);
            let between = self.between(&laid)?;
            if between.is_empty() {
                break;
            }
            places.extend(between);
            sort(&mut places);
        }
        // A tenth of a millimetre makes a visible step between stations that are near each other.
        let near = NEAR * self.grid.every;
        let gaps: Vec<f64> = places.windows(2).map(|two| two[1].x - two[0].x).collect();
        for (k, place) in places.iter_mut().enumerate() {
            let beside = [k.checked_sub(1), Some(k)].into_iter().flatten();
            if beside.filter_map(|k| gaps.get(k)).any(|gap| *gap > 0.0 && *gap < near) {
                place.finer = FINER;
            }
        }
        Ok(stations(&places))
    }

    /// The bat's own stations, and even places where it changes.
    fn places(&self) -> Vec<StationPlace> {
        let profile = self.bat.profile();
        let own = &profile.stations;
        let mut places = vec![];
        for (k, x) in own.x.iter().enumerate() {
            // At a step, the first belongs to the piece to its left; a bat that is cut has several between two
            // stations.
            let left = k > 0 && (k + 1 == own.x.len() || own.x[k + 1] == *x);
            let to = if left { own.x[k - 1] } else { own.x[(k + 1).min(own.x.len() - 1)] };
            places.push(StationPlace { x: *x, inside: x + BESIDE * (to - x), finer: 1.0 });
        }
        let length = profile.length();
        let near = |x: f64| own.x.iter().any(|y| (y - x).abs() < NEAR * self.grid.every);
        let count = (length / self.grid.every).floor() as usize;
        for k in 1..=count {
            let x = k as f64 * self.grid.every;
            let wanted = self.change(x) != 0.0 || !self.is_of_stations();
            if wanted && !near(x) && x < length {
                places.push(StationPlace { x, inside: x, finer: 1.0 });
            }
        }
        sort(&mut places);
        places
    }

    /// Places between two stations where the curve through them departs from the changed one.
    fn between(&self, laid: &[Station]) -> Result<Vec<StationPlace>> {
        let through = self.profile(laid, |station| station.exact)?;
        let far = |from: f64, to: f64| {
            (1..4).any(|k| {
                let x = from + 0.25 * f64::from(k) * (to - from);
                let (old, new) = (section(self.bat.profile(), x, x), section(&through, x, x));
                let change = self.change(x);
                let may =
                    if change == 0.0 { BESIDE_KEPT } else { BESIDE_CHANGED * self.grid.round };
                let beside = 2.0 * (new.outer - old.outer) - change;
                beside.abs() > may || 2.0 * (new.inner - old.inner).abs() > BESIDE_KEPT
            })
        };
        let middle = |ends: &[Station]| {
            let (from, to) = (ends[0].x, ends[1].x);
            let x = 0.5 * (from + to);
            let wanted = to - from > 2.0 * CLOSEST && far(from, to);
            wanted.then_some(StationPlace { x, inside: x, finer: FINER })
        };
        Ok(laid.windows(2).filter_map(middle).collect())
    }

    fn station(&self, place: StationPlace) -> Station {
        let StationPlace { x, inside, finer } = place;
        let at = section(self.bat.profile(), x, inside);
        let (old, kept) = (2.0 * at.outer, !self.is_free(x));
        let room = self.limits.room(x, at);
        let change = self.change(x);
        let (low, high) = (old + room.low, old + room.high);
        // Rounding moves the curve beside a station too; a kept stretch should be affected little.
        let aside = 1.5 * self.grid.every;
        let beside_kept = [x - aside, x + aside].into_iter().any(|x| self.is_kept(x));
        let finer = match () {
            () if beside_kept => FINER * FINER,
            // The end of the change, as between the even stations.
            () if change.abs() < self.grid.round => FINER,
            () => finer,
        };
        let round = self.grid.round / finer;
        let exact = old + change;
        Station { x, old, exact, new: old, inner: at.inner, low, high, round, kept }
    }

    /// The profile through those stations, with those diameters.
    ///
    /// # Errors
    ///
    /// Those of [`Profile::new`].
    pub fn profile(
        &self,
        stations: &[Station],
        diameter: impl Fn(&Station) -> f64,
    ) -> Result<Profile> {
        let profile = self.bat.profile();
        let bent = |radii: &Radii| match radii {
            Radii::Cubic(cubics) => cubics.degree > 1,
            Radii::Formula(_) => true,
        };
        let interpolation = match profile.pieces.iter().any(|piece| bent(&piece.radii)) {
            true => Interpolation::Pchip,
            false => Interpolation::Linear,
        };
        Profile::new(Stations {
            x: stations.iter().map(|station| station.x).collect(),
            outer: stations.iter().map(|station| 0.5 * diameter(station)).collect(),
            inner: stations.iter().map(|station| station.inner).collect(),
            interpolation,
        })
    }
}

/// Sorts from the knob; at a step the station to its left comes first.
fn sort(places: &mut [StationPlace]) {
    places.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.inside.total_cmp(&b.inside)));
}
