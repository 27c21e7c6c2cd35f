//! How are the readings of a bat written? The `sweetspot-readings/1` file.

use std::ops::Bound::Excluded;

use crate::calibrate::labels::MOST_MODES;
use crate::calibrate::readings::{
    BatReadings, Pendulum, Priors, Reading, RingDown, ShearPrior, SpectralLine,
};
use crate::calibrate::unknowns::covariance;
use crate::engine::{Node, Quantity, Result, STANDARD_PIVOT, inverse, mistakes};
use crate::files::amounts::{reading, share};
use crate::files::form::{Form, amount, list, number, sound, text};
use crate::files::written::{object, written};

written! {
    /// Readings of a bat, for sweetspot calibrate: by scale, ruler, pendulum and microphone. At least one reading;
    /// places count from the knob end.
    ReadingsForm("readings", "Readings file") {
        /// Name of the readings.
        name = text();
        /// Mass with everything attached. Without an uncertainty it is 1 g.
        mass = reading(Quantity::Mass, 1e-3, [0.1, 5.0]).like("0.869 kg ± 1 g");
        /// Balance point from the knob end. Without an uncertainty it is 1 mm.
        balance_point = reading(Quantity::Length, 1e-3, [0.05, 1.5]).like("56.1 cm ± 1 mm");
        /// A swing of the hanging bat.
        pendulum = object::<PendulumForm>();
        /// Lines in the spectrum of a tap.
        lines = list(object::<LineForm>());
        /// Tones that died out.
        ring_down = list(object::<ToneForm>());
        /// Relative error of the beam model in a frequency, one standard deviation. By default 0.3 %.
        model = share().like("0.3 %");
        /// Prior uncertainty of the wood. By default that of one species around the bat file's values.
        priors = object::<PriorsForm>();
    }
    |of| -> BatReadings {
        let (lines, heard): (Vec<SpectralLine>, Vec<Option<RingDown>>) =
            lines.unwrap_or_default().into_iter().unzip();
        let died = ring_down.unwrap_or_default().into_iter().chain(heard.into_iter().flatten());
        if let Some(node) = of.at("lines") {
            let told = each_once(node, &lines);
            of.mistakes.note(told);
        }
        Ok(BatReadings {
            mass,
            balance_point,
            pendulum,
            lines,
            unlike: 0,
            ring_down: died.collect(),
            model: model.unwrap_or(BatReadings::MODEL),
            priors: priors.unwrap_or_default(),
        })
    }
}

written! {
    /// A swing of the hanging bat.
    PendulumForm {
        /// Position of the pivot, on the knob side of the balance point. By default 6 in from the knob end.
        pivot = amount(Quantity::Length).like("6 in");
        /// Time of a swing there and back. Without an uncertainty it is 1 ms.
        period = reading(Quantity::Time, 1e-3, [0.3, 5.0]).like("1.470 s ± 1 ms"),
            needed "\"period\" of a swing there and back, such as \"1.470 s ± 1 ms\"";
    }
    |_| -> Pendulum { Ok(Pendulum { pivot: pivot.unwrap_or(STANDARD_PIVOT), period }) }
}

const LOSS: &str = "a \"loss_factor\" between 0 and 0.5";

written! {
    /// A line in the spectrum of a tap.
    LineForm {
        /// Frequency of the line.
        hz = reading(Quantity::Frequency, 0.5, [10.0, 20e3]).like(174.5),
            needed "\"hz\": the frequency of the line";
        /// Standard deviation of the reading. By default that of the text, else 0.5 Hz.
        within = amount(Quantity::Frequency).like(0.3);
        /// Number of the bending mode, from 1. By default the program finds it.
        mode = order();
        /// Loss factor of the tone, whose mode must be given.
        loss_factor = number().within((Excluded(0.0), Excluded(0.5)), LOSS);
    }
    |of| -> (SpectralLine, Option<RingDown>) {
        if let (Some(_), Some(node), None) = (loss_factor, of.at("loss_factor"), of.at("mode")) {
            of.mistakes.add(node.error("a loss factor without \"mode\"", "the \"mode\" of the tone beside it"));
        }
        if let (Some(node), Some(within)) = (of.at("within"), within) {
            // A line that could not be read is not a bound.
            let below = hz == Reading::default() || within < hz.value;
            let expected = "an uncertainty above 0 Hz and below the line";
            let told = sound(node, within > 0.0 && below, expected);
            of.mistakes.note(told);
        }
        let deviation = within.unwrap_or(hz.deviation);
        let heard = mode.zip(loss_factor).map(|(mode, loss)| RingDown::of_loss(mode, loss));
        Ok((SpectralLine { frequency: Reading { deviation, ..hz }, mode }, heard))
    }
}

const CYCLES: &str = "\"cycles\" that were counted, more than 0 and below 100000";
const RATIO: &str = "\"ratio\" of the amplitude after them to that before, between 0 and 1";

written! {
    /// A tone that died out: cycles and the ratio of amplitudes after them, or its loss factor.
    ToneForm {
        /// Which bending mode it is, from 1.
        mode = order(), needed "\"mode\": which bending mode died out";
        /// Number of cycles.
        cycles = number().within((Excluded(0.0), Excluded(1e5)), CYCLES);
        /// Amplitude after them over that before.
        ratio = number().within((Excluded(0.0), Excluded(1.0)), RATIO);
        /// Loss factor, in place of cycles and ratio.
        loss_factor = number().within((Excluded(0.0), Excluded(0.5)), LOSS);
    }
    |of| -> RingDown {
        for counted in ["cycles", "ratio"] {
            let both = of.object.one_of(&[counted, "loss_factor"]).map(|_| ());
            of.mistakes.note(both);
        }
        let is_there = |key: &'static str| of.object.get(key).is_some();
        let lacks = if is_there("cycles") { ("no \"ratio\"", RATIO) } else { ("no \"cycles\"", CYCLES) };
        let counted = is_there("cycles") && is_there("ratio");
        if !(counted || is_there("loss_factor")) {
            let expected = format!("{}, or {LOSS}", lacks.1);
            of.mistakes.add(of.object.node.error(lacks.0, &*expected));
        }
        Ok(match loss_factor {
            Some(loss) => RingDown::of_loss(mode, loss),
            None => RingDown { mode, cycles: cycles.unwrap_or_default(), ratio: ratio.unwrap_or_default() },
        })
    }
}

written! {
    /// Prior uncertainty of the wood: standard deviations of natural logarithms, and correlations.
    PriorsForm {
        /// Of Young's modulus. Without it 22 %.
        youngs_modulus = share();
        /// Of G/E. Without it 35 %, unless shear_modulus is there.
        shear_over_young = share().map(ShearPrior::OverYoung);
        /// Of G alone, independent of E, in place of shear_over_young.
        shear_modulus = share().map(ShearPrior::Alone);
        /// Of the density. Without it 10 %.
        density = share();
        /// Correlation of Young's modulus and density. Without it 0.6.
        correlation = correlation_of();
        /// Of Young's modulus in the barrel over that in the handle. Without it 8 %.
        youngs_modulus_ratio = share();
        /// Correlation of the densities of handle and barrel. Without it 0.95.
        densities_together = correlation_of();
    }
    |of| -> Priors {
        let both = of.object.one_of(&["shear_over_young", "shear_modulus"]).map(|_| ());
        of.mistakes.note(both);
        let usual = Priors::default();
        let priors = Priors {
            youngs_modulus: youngs_modulus.unwrap_or(usual.youngs_modulus),
            shear: shear_over_young.or(shear_modulus).unwrap_or(usual.shear),
            density: density.unwrap_or(usual.density),
            correlation: correlation.unwrap_or(usual.correlation),
            modulus_ratio: youngs_modulus_ratio.unwrap_or(usual.modulus_ratio),
            densities_together: densities_together.unwrap_or(usual.densities_together),
        };
        if inverse(&covariance(&priors, 2)).is_none() {
            let found = "correlations that contradict each other";
            let expected = "correlations that can be: of density in handle and barrel, and of both with E";
            of.mistakes.add(of.object.node.error(found, expected));
        }
        Ok(priors)
    }
}

/// A correlation.
fn correlation_of() -> Form<f64> {
    number().within((Excluded(-1.0), Excluded(1.0)), "a number between -1 and 1")
}

/// The number of a bending mode.
fn order() -> Form<usize> {
    let order = Form::of::<u32>(|node| {
        let value = node.number()?;
        let is_one = value.fract() == 0.0 && (1.0..=MOST_MODES as f64).contains(&value);
        let expected = format!("the number of a bending mode, 1 to {MOST_MODES}");
        sound(node, is_one, &expected).map(|()| value as usize)
    });
    order.saying("minimum", 1).saying("maximum", MOST_MODES)
}

/// Refuses a mode or a frequency that is there twice; a frequency that could not be read is 0.
fn each_once(node: &Node, lines: &[SpectralLine]) -> Result<()> {
    let again = |k: usize| {
        let (mode, hz) = (lines[k].mode, lines[k].frequency.value);
        let same_mode = |line: &SpectralLine| mode.is_some() && line.mode == mode;
        lines[..k].iter().any(|line| same_mode(line) || hz > 0.0 && line.frequency.value == hz)
    };
    mistakes::all((0..lines.len()).filter(|k| again(*k)).map(|k| {
        Err::<(), _>(node.item(k).error("a line a second time", "every mode once, every line once"))
    }))
    .map(|_| ())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::written::WrittenFile;

    #[test]
    fn a_line_with_a_loss_factor_is_a_tone_that_died_out() {
        let read = |members: &str| {
            let text = format!("{{ \"format\": \"sweetspot-readings/1\", {members} }}");
            ReadingsForm::from_text("readings", &text, "".as_ref()).unwrap()
        };
        let line = read(r#""lines": [{ "hz": 174.5, "mode": 1, "loss_factor": 0.011 }]"#);
        let apart = read(
            r#""lines": [{ "hz": 174.5, "mode": 1 }],
               "ring_down": [{ "mode": 1, "loss_factor": 0.011 }]"#,
        );
        assert_eq!(line, apart);
        assert!((line.ring_down[0].loss_factor() / 0.011 - 1.0).abs() < 1e-12);
    }
}
