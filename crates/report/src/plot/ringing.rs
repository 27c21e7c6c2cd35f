//! How the bat moves in time: watched places after a hit, their spectrum, the strain along the bat, and
//! the whole bat after a blow, under a force or from a shape.

use crate::plot::{
    Axis, Chart, MARKS, Panel, Picture, SERIES, Series, Sheet, Unit, along, heights, short,
    ticks_up,
};
use crate::schema::ring::{AfterHit, Motion};
use sweetspot::base::units::INCH;
use sweetspot::collision::aftermath::{Aftermath, Line, Watched};

/// Heights of a diagram of motion and of a single diagram (px).
const MOTION: f64 = 130.0;
const ALONE: f64 = 250.0;
/// Instants of a curve, and at most of all.
const INSTANTS: usize = 900;
const IN_ALL: usize = 3600;
/// Most curves in one picture; more cannot be distinguished.
const MOST: usize = 6;

/// `motion` and `spectrum` of the first six watched places, and `strain` along the bat.
pub fn after_hit(sheet: Sheet, after: &Aftermath, seen: &AfterHit) -> Vec<Picture> {
    let all = AfterBall { after, seen, bat: after.bat().name() };
    [all.motion(sheet), all.spectrum(sheet), all.strain(sheet)].into_iter().flatten().collect()
}

/// A bat after a hit, its motion, and its name.
struct AfterBall<'a> {
    after: &'a Aftermath<'a>,
    seen: &'a AfterHit,
    bat: &'a str,
}

impl AfterBall<'_> {
    fn facts(&self, sheet: Sheet) -> String {
        format!("hit at {} from the knob end", along(sheet, self.after.place))
    }

    fn name(sheet: Sheet, x: f64) -> String {
        format!("at {}", along(sheet, x))
    }

    /// Displacement, velocity and, of a damped bat, acceleration against time.
    fn motion(&self, sheet: Sheet) -> Option<Picture> {
        if self.seen.until <= 0.0 || self.seen.watched.is_empty() {
            return None;
        }
        let curves = self.seen.watched.len().min(MOST) * if self.seen.damped { 3 } else { 2 };
        let last = INSTANTS.min(IN_ALL / curves);
        let times: Vec<f64> =
            (0..=last).map(|k| self.seen.until * k as f64 / last as f64).collect();
        let instants = self.after.at(&times);
        let (name, per) =
            if sheet.us { ("kft/s²", 1e-3 / (12.0 * INCH)) } else { ("km/s²", 1e-3) };
        let shaken = Unit { name, per };
        let kinds = [("displacement", sheet.small()), ("velocity", sheet.speed())];
        let kinds = kinds.into_iter().chain(self.seen.damped.then_some(("acceleration", shaken)));
        let kinds: Vec<(&str, Unit)> = kinds.collect();
        let curves = |kind: usize| -> Vec<Series> {
            let curve = |(k, Watched { x_m, .. }): (usize, &Watched)| {
                let value = |now| self.after.motion(*x_m, now)[kind];
                let points = instants.iter().map(|now| Some([1e3 * now.time, value(now)]));
                Series::curve(&Self::name(sheet, *x_m), k, points.collect())
            };
            self.seen.watched.iter().take(MOST).enumerate().map(curve).collect()
        };
        let title = "Motion after the hit";
        let facts = format!("{}; against the swing; tinted: the ball is there", self.facts(sheet));
        let x = Axis::new("time since the first touch", [0.0, 1e3 * self.seen.until]);
        let chart = Chart::new("motion", title, [self.bat, &facts], x.counted_in(Unit::MS));
        let mut chart = chart.keys(&curves(0));
        let mut told = vec![];
        for (k, (what, unit)) in kinds.into_iter().enumerate() {
            let all = curves(k);
            told.push(format!("{what} up to {}", most(&all, unit)));
            let panel = Panel::around(MOTION, (what, unit), all, &[0.0]).zero();
            chart = chart.panel(panel.band(Some([0.0, 1e3 * self.after.end()]), SERIES[5]));
        }
        let alt = format!("{title} of {}, {facts}. {}.", self.bat, told.join(", "));
        Some(chart.picture(sheet, &alt))
    }

    /// Velocity of every mode at the watched places after the contact, a line each.
    fn spectrum(&self, sheet: Sheet) -> Option<Picture> {
        let unit = sheet.speed();
        let lines = || self.seen.watched.iter().take(MOST).flat_map(|seen| seen.spectrum.iter());
        let highest = lines().map(|line| line.frequency_hz).fold(0.0, f64::max);
        let largest = lines().map(|line| line.velocity_m_s).fold(0.0, f64::max);
        // The visible lines.
        let seen = lines().filter(|line| line.velocity_m_s >= 0.003 * largest);
        let end = seen.map(|line| line.frequency_hz).fold(0.0, f64::max).min(highest);
        if end <= 0.0 || largest <= 0.0 {
            return None;
        }
        let curve = |(k, Watched { x_m, spectrum, .. }): (usize, &Watched)| {
            let stem = |line: &Line| {
                let (f, size) = (line.frequency_hz, line.velocity_m_s);
                [Some([f, 0.0]), Some([f, size]), None]
            };
            let points =
                spectrum.iter().filter(|line| line.frequency_hz <= end).flat_map(stem).collect();
            Series::curve(&Self::name(sheet, *x_m), k, points)
        };
        let stems: Vec<Series> =
            self.seen.watched.iter().take(MOST).enumerate().map(curve).collect();
        // Coinciding lines are distinguished by the marks at their ends.
        let ends = |(k, stems): (usize, &Series)| {
            let points = stems.points.iter().skip(1).step_by(3).copied().collect();
            Series { points, ..stems.clone() }.dots(MARKS[k % MARKS.len()]).untold()
        };
        let mut curves: Vec<Series> = stems.iter().enumerate().map(ends).collect();
        let title = "Spectrum when the ball has left";
        let facts = format!("{}; velocity of every mode", self.facts(sheet));
        let x = Axis::new("frequency", [0.0, 1.05 * end]).counted_in(Unit::HZ);
        let chart = Chart::new("spectrum", title, [self.bat, &facts], x).keys(&curves);
        curves.extend(stems);
        let told = lines().filter(|line| line.velocity_m_s >= 0.1 * largest).map(|line| {
            format!(
                "{} Hz {} {}",
                short(line.frequency_hz),
                short(unit.per * line.velocity_m_s),
                unit.name
            )
        });
        let told = told.collect::<Vec<_>>().join(", ");
        let alt = format!("{title}, {}, {facts}. Largest: {told}.", self.bat);
        let y = Axis::measured("velocity", unit, [0.0, largest].into_iter(), ticks_up(ALONE));
        Some(chart.panel(Panel::new(ALONE, y, curves).zero()).picture(sheet, &alt))
    }

    /// The largest strain of the surface at every place.
    fn strain(&self, sheet: Sheet) -> Option<Picture> {
        let points: Vec<_> = self.seen.along.iter().map(|at| Some([at.x_m, at.strain])).collect();
        let most = self.seen.along.iter().max_by(|a, b| a.strain.total_cmp(&b.strain))?;
        if most.strain <= 0.0 {
            return None;
        }
        let share = Unit { name: "%", per: 100.0 };
        let title = "Largest strain along the bat";
        let facts = format!("{}; at the outermost fibre", self.facts(sheet));
        let [at, size] = [along(sheet, most.x_m), short(share.per * most.strain)];
        let alt = format!("{title} of {}, {facts}: {size} % at {at}.", self.bat);
        let length = self.after.bat().length();
        let ends = ([0.0, length], &[(self.bat, length)][..]);
        let chart = Chart::along(sheet, ("strain", title), [self.bat, &facts], ends);
        let curves = vec![Series::curve("largest strain", 0, points)];
        let panel = Panel::around(ALONE, ("strain", share), curves, &[0.0]).zero();
        Some(chart.panel(panel).picture(sheet, &alt))
    }
}

/// The largest size that curves have, with its unit.
fn most(curves: &[Series], unit: Unit) -> String {
    let most = heights(curves).map(|value| (unit.per * value).abs()).fold(0.0, f64::max);
    format!("{} {}", short(most), unit.name)
}

/// The deflected bat at some of the instants, six at most; picture `deflection`. None without one.
pub fn moving(sheet: Sheet, bat: &str, motion: &Motion) -> Option<Picture> {
    let Motion { x_m: x, times_s: times, deflection_m: frames, .. } = motion;
    let length = *x.last()?;
    let count = frames.len().min(MOST);
    let last = frames.len().checked_sub(1)?;
    let shown: Vec<usize> = (0..count).map(|k| k * last / (count - 1).max(1)).collect();
    let unit = sheet.small();
    let curve = |(k, frame): (usize, &usize)| {
        let points = x.iter().zip(&frames[*frame]).map(|(x, w)| Some([*x, *w])).collect();
        let name = format!("{} ms", short(1e3 * times[*frame]));
        Series::curve(&name, k, points)
    };
    let curves: Vec<Series> = shown.iter().enumerate().map(curve).collect();
    let title = "Deflection along the bat in time";
    let facts = match count < frames.len() {
        true => format!("{count} of {} instants", frames.len()),
        false => String::new(),
    };
    let [from, to] = [times[shown[0]], times[shown[count - 1]]].map(|t| short(1e3 * t));
    let alt = format!("{title}, {bat}, {from} to {to} ms: up to {}.", most(&curves, unit));
    let ends = ([0.0, length], &[(bat, length)][..]);
    let chart = Chart::along(sheet, ("deflection", title), [bat, &facts], ends).keys(&curves);
    let panel = Panel::around(ALONE, ("deflection", unit), curves, &[0.0]).zero();
    Some(chart.panel(panel).picture(sheet, &alt))
}
