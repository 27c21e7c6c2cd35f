//! Conversion from a value to a place along an axis, and the round values of its ticks.

use crate::plot::sheet::Unit;

/// How an axis counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// As they are.
    Linear,
    /// Equal ratios are equally long; values are above 0.
    Log,
    /// As they are, with a tick at every quarter of a turn (deg).
    Turn,
}

/// The label of an axis, and the values at its ends; the first may be the larger.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// With its unit: `exit speed (m/s)`.
    pub label: String,
    /// The value at the left or lower end.
    pub from: f64,
    /// The value at the right or upper end.
    pub to: f64,
    /// Number of units of the ticks per unit of the values: 100 for values in m and ticks in cm.
    pub per: f64,
    /// The name of that unit, possibly empty.
    pub unit: &'static str,
    /// How values lie between the ends.
    pub scale: Scale,
}

/// A value with a tick, and how it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// The value of the axis at the tick.
    pub value: f64,
    /// The text of the tick.
    pub text: String,
}

/// With more decades than this, only some of them have ticks.
const DECADES: usize = 9;

impl Axis {
    /// An axis with the given ends; equal ends are moved apart.
    pub fn new(label: &str, [from, to]: [f64; 2]) -> Self {
        let [from, to] = if from.is_finite() && to.is_finite() { [from, to] } else { [0.0, 1.0] };
        // Closer ends would have ticks with more digits than are useful.
        let least = 1e-3 * from.abs().max(to.abs());
        let by = if least == 0.0 { 1.0 } else { least };
        let same = (to - from).abs() <= least;
        let [from, to] = if same { [from.min(to) - by, from.max(to) + by] } else { [from, to] };
        Self { label: label.into(), from, to, per: 1.0, unit: "", scale: Scale::Linear }
    }

    /// An axis long enough for those values, with a tick at both ends, and with at most that number of ticks.
    pub fn around(label: &str, values: impl Iterator<Item = f64>, most: usize) -> Self {
        let axis = Self::new(label, ends(values).unwrap_or([0.0, 1.0]));
        let [mut from, mut to] = [axis.from, axis.to];
        // The longer axis may have longer steps, which may make it longer again.
        for _ in 0..4 {
            let step = step(to - from, most);
            // A value that is a tick but for its last digits is one.
            from = step * (axis.from / step + 1e-9).floor();
            to = step * (axis.to / step - 1e-9).ceil();
        }
        Self { from, to, ..axis }
    }

    /// A logarithmic axis of whole powers of ten around the positive ones of those values.
    pub fn logarithmic(label: &str, values: impl Iterator<Item = f64>) -> Self {
        let [low, high] = ends(values.filter(|v| *v > 0.0)).unwrap_or([1.0, 10.0]);
        let from = (low.log10() + 1e-9).floor();
        let to = (high.log10() - 1e-9).ceil().max(from + 1.0);
        let [from, to] = [from, to].map(|power| 10f64.powf(power));
        Self { label: label.into(), from, to, per: 1.0, unit: "", scale: Scale::Log }
    }

    /// This axis, whose ends were given in that unit, for values in SI.
    pub fn counted_in(self, unit: Unit) -> Self {
        let Unit { name: unit, per } = unit;
        let label = if unit.is_empty() { self.label } else { format!("{} ({unit})", self.label) };
        Self { label, from: self.from / per, to: self.to / per, per, unit, ..self }
    }

    /// An axis in that unit, long enough for those values in SI, with a tick at both ends and at most that number of
    /// ticks.
    pub fn measured(
        label: &str,
        unit: Unit,
        values: impl Iterator<Item = f64>,
        most: usize,
    ) -> Self {
        Self::around(label, values.map(|value| unit.per * value), most).counted_in(unit)
    }

    /// Half a turn to either side (deg).
    pub fn of_a_turn(label: &str) -> Self {
        let axis = Self::new(label, [-180.0, 180.0]).counted_in(Unit { name: "deg", per: 1.0 });
        Self { scale: Scale::Turn, ..axis }
    }

    /// How far along the axis a value is: 0 at its beginning, 1 at its end.
    pub fn share(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear | Scale::Turn => (value - self.from) / (self.to - self.from),
            Scale::Log => (value / self.from).ln() / (self.to / self.from).ln(),
        }
    }

    /// Whether a value is on it.
    pub fn holds(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.share(value))
    }

    /// Round values on the axis, at most the given number: spaced by 1, 2 or 5 times a power of ten, or powers of ten.
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        let [from, to] = [self.from * self.per, self.to * self.per];
        let [low, high] = [from.min(to), from.max(to)];
        match self.scale {
            Scale::Linear | Scale::Turn => {
                let step = match self.scale {
                    Scale::Turn => 90.0,
                    _ => step(high - low, most),
                };
                let [first, last] =
                    [(low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64];
                let tick = |k: i64| {
                    let value = k as f64 * step;
                    Tick { value: value / self.per, text: shown(value, step) }
                };
                (first..=last).map(tick).collect()
            }
            Scale::Log => {
                let [first, last] = [low, high].map(|value| value.log10().round() as i32);
                let every = ((last - first) as usize).div_ceil(most.clamp(1, DECADES)).max(1);
                let plain = first >= -2 && last <= 3;
                let power =
                    |k: i32| Tick { value: 10f64.powi(k) / self.per, text: power_of_ten(k, plain) };
                (first..=last).step_by(every).map(power).collect()
            }
        }
    }
}

/// The smallest and largest finite value.
fn ends(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let finite = values.filter(|value| value.is_finite());
    finite.fold(None, |ends, value| match ends {
        None => Some([value; 2]),
        Some([low, high]) => Some([f64::min(low, value), f64::max(high, value)]),
    })
}

/// 1, 2 or 5 times a power of ten: the smallest that divides that length into fewer parts than the given number.
pub fn step(length: f64, most: usize) -> f64 {
    let least = length.abs() / (most.max(2) - 1) as f64;
    let power = 10f64.powf(least.log10().floor());
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| factor * power >= least * (1.0 - 1e-9));
    factor.unwrap_or(10.0) * power
}

/// The number of a tick, with as many decimals as the ticks need.
pub fn shown(value: f64, step: f64) -> String {
    let places = (step * (1.0 + 1e-9)).log10().floor();
    let decimals = (-places).max(0.0) as usize;
    // Neither −0 nor a multiple of the step that is almost 0.
    let value = if value.abs() < 0.5 * step { 0.0 } else { value };
    if value == 0.0 {
        return "0".into();
    }
    if decimals > 4 || value.abs() >= 1e6 {
        let digits = (value.abs().log10().floor() - places).max(0.0) as usize;
        return format!("{value:.digits$e}").replace('-', "−");
    }
    format!("{value:.decimals$}").replace('-', "−")
}

/// A power of ten, in full or as a power: all ticks of an axis have the same style.
fn power_of_ten(k: i32, plain: bool) -> String {
    match plain {
        true => format!("{:.*}", (-k).max(0) as usize, 10f64.powi(k)),
        false => format!("1e{k}").replace('-', "−"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_one_two_or_five_times_a_power_of_ten_apart() {
        for k in 0..400 {
            let length = 1.07f64.powi(k - 200);
            let step = step(length, 6);
            let digit = step / 10f64.powf((step * (1.0 + 1e-9)).log10().floor());
            assert!([1.0, 2.0, 5.0].iter().any(|d| (digit / d - 1.0).abs() < 1e-9), "{step}");
            assert!(length / step <= 5.0 + 1e-6 && length / step > 1.9, "{length} {step}");
            for from in [0.0, 0.3 * length, -0.7 * length] {
                let axis = Axis::new("x", [from, from + length]);
                let ticks = axis.ticks(6);
                assert!((1..=6).contains(&ticks.len()), "{axis:?}");
                assert!(ticks.iter().all(|tick| axis.holds(tick.value)));
                let around = Axis::around("x", [from, from + length].into_iter(), 6);
                let ends = around.ticks(7);
                assert!((ends[0].value - around.from).abs() < 1e-6 * length);
                assert!(around.holds(from) && around.holds(from + length));
            }
        }
    }

    #[test]
    fn numbers_have_the_decimals_of_their_step() {
        let all = [(0.3, 0.1), (-0.0, 0.1), (5.0, 5.0), (0.25, 0.05), (-20.0, 10.0), (2e-7, 1e-7)];
        let texts = all.map(|(value, step)| shown(value, step));
        assert_eq!(texts, ["0.3", "0", "5", "0.25", "−20", "2e−7"]);
        assert_eq!([-2, 0, 3].map(|k| power_of_ten(k, true)), ["0.01", "1", "1000"]);
        assert_eq!([-13, 0, 5].map(|k| power_of_ten(k, false)), ["1e−13", "1e0", "1e5"]);
    }

    #[test]
    fn an_axis_counted_in_another_unit_has_round_ticks_there() {
        let unit = Unit { name: "in", per: 1.0 / 0.0254 };
        let axis = Axis::around("from the knob end", [0.0, 33.0].into_iter(), 6).counted_in(unit);
        assert_eq!(axis.label, "from the knob end (in)");
        let ticks = axis.ticks(6);
        assert!(
            ticks.iter().any(|t| t.text == "20" && (t.value - 0.508).abs() < 1e-12),
            "{ticks:?}"
        );
        assert!(axis.holds(0.838) && !axis.holds(1.2));
    }

    #[test]
    fn an_axis_of_one_value_or_none_has_a_length() {
        for values in [vec![], vec![0.0], vec![3.0, 3.0], vec![f64::NAN], vec![-1e-20, -1e-20]] {
            let axis = Axis::around("x", values.iter().copied(), 6);
            assert!(axis.to > axis.from && axis.ticks(6).len() > 1, "{values:?} {axis:?}");
        }
        let axis = Axis::logarithmic("x", [0.0, 1e-3].into_iter());
        assert_eq!(axis.ticks(6).len(), 2, "{axis:?}");
    }

    #[test]
    fn equal_ratios_are_equally_long_on_a_logarithmic_axis() {
        let axis = Axis::logarithmic("x", [2e-4, 0.5].into_iter());
        assert!((axis.share(1e-2) - 0.5).abs() < 1e-12 && axis.share(1.0) == 1.0);
        assert_eq!(axis.ticks(9).len(), 5);
    }
}
