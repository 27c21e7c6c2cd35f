//! The summary: the numbers a bat maker asks for first.

use schemars::JsonSchema;
use serde::Serialize;

use crate::analysis::Analysis;
use crate::parts::Quantity::{Frequency, Inertia, Length, Mass, Speed};
use crate::parts::{Fact, Units, fixed};
use crate::report::trust::about;
use sweetspot::bat::body::STANDARD_PIVOT;
use sweetspot_study::answers::Answer;

/// The numbers of the summary, in SI, as in the data of the page; None for an unknown number.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Summary {
    /// Length from the knob end to the tip (m).
    pub length_m: f64,
    /// Mass with everything attached (kg).
    pub mass_kg: f64,
    /// Centre of mass, from the knob end (m).
    pub balance_point_m: f64,
    /// Swing weight: moment of inertia about the point 6 in from the knob end (kg m²).
    pub inertia_pivot_kg_m2: f64,
    /// Centre of percussion for a pivot 6 in from the knob end (m).
    pub center_of_percussion_m: Option<f64>,
    /// Frequencies of the first modes, three at most (Hz).
    pub frequencies_hz: Vec<f64>,
    /// Position of the highest exit speed (m from the knob end).
    pub sweet_spot_m: Option<f64>,
    /// The exit speed there (m/s).
    pub exit_speed_m_s: Option<f64>,
    /// From where to where it is within 1 % of that (m from the knob end).
    pub zone_m: Option<[f64; 2]>,
    /// Bat-ball coefficient of restitution at the sweet spot, of the free bat.
    pub bbcor: Option<f64>,
    /// Bat-ball coefficient of restitution at the sweet spot, of the bat held 6 in from the knob.
    pub bbcor_pivoted: Option<f64>,
    /// Angular speed of the swing (rad/s).
    pub swing_rad_s: f64,
    /// Speed of the ball towards the bat (m/s).
    pub ball_speed_m_s: f64,
}

impl Summary {
    /// The summary of an analysis.
    pub fn new(analysis: &Analysis) -> Self {
        let Analysis { bat, solution, task, figures, .. } = analysis;
        let inertia = bat.inertia();
        let best = figures.best.as_ref().and_then(|best| best.outcome.as_ref());
        Self {
            length_m: bat.length(),
            mass_kg: inertia.mass,
            balance_point_m: inertia.balance_point,
            inertia_pivot_kg_m2: inertia.about(STANDARD_PIVOT),
            center_of_percussion_m: inertia.center_of_percussion(STANDARD_PIVOT),
            frequencies_hz: solution.modes.iter().take(3).map(|mode| mode.frequency()).collect(),
            sweet_spot_m: figures.spot.exit_speed_max.map(|peak| peak.x),
            exit_speed_m_s: figures.spot.exit_speed_max.map(|peak| peak.value),
            zone_m: figures.spot.zone,
            bbcor: best.map(|outcome| outcome.bbcor),
            bbcor_pivoted: best.map(|outcome| outcome.bbcor_pivoted),
            swing_rad_s: task.scene.swing,
            ball_speed_m_s: task.scene.ball_speed,
        }
    }

    /// The three answers: where the sweet spot is, how fast the ball leaves and how wide the zone is, with their
    /// uncertainty. Empty where no ball is hit.
    pub fn headline(&self, units: Units, analysis: &Analysis) -> Vec<Fact> {
        let (Some(x), Some(speed), Some([from, to])) =
            (self.sweet_spot_m, self.exit_speed_m_s, self.zone_m)
        else {
            return vec![];
        };
        let tip = format!("{} from the tip", Length.said(units, self.length_m - x));
        let scene = format!(
            "swing {} rad/s, pitch {}",
            fixed(self.swing_rad_s, 1),
            Speed.said(units, self.ball_speed_m_s)
        );
        let of = Length.scale(units.us_first());
        let zone = format!("{} to {} from the knob", of.value(from), of.text(to));
        let [tip, scene] = [(tip, Answer::ExitSpeedPlace), (scene, Answer::ExitSpeed)]
            .map(|(note, answer)| with_open(note, about(analysis, answer, units)));
        let (place, width) = (Length.said(units, x), Length.said(units, to - from));
        vec![
            fact("sweet_spot_m", "Sweet spot, from the knob", place, tip),
            fact("exit_speed_m_s", "Fastest ball", Speed.said(units, speed), scene),
            fact("zone_m", "Sweet zone, within 1 % of it", width, zone),
        ]
    }

    /// All other figures for which there are numbers.
    pub fn facts(&self, units: Units, analysis: &Analysis) -> Vec<Fact> {
        let mut facts = self.body(units, analysis);
        if let Some((first, others)) = self.frequencies_hz.split_first() {
            let others: Vec<String> = others.iter().map(|f| fixed(*f, 1)).collect();
            let note = match others.is_empty() {
                true => String::new(),
                false => format!("then {} Hz", others.join(" and ")),
            };
            let note = with_open(note, about(analysis, Answer::Frequency(1), units));
            let value = Frequency.said(units, *first);
            facts.push(fact("frequencies_hz", "First bending frequency", value, note));
        }
        if let (Some(free), Some(held)) = (self.bbcor, self.bbcor_pivoted) {
            let note = format!("{held:.3} held 6 in from the knob; computed, not certified");
            facts.push(fact("bbcor", "BBCOR-like figure", format!("{free:.3}"), note));
        }
        facts
    }

    /// The bat as a rigid body.
    fn body(&self, units: Units, analysis: &Analysis) -> Vec<Fact> {
        let from_tip = |x: f64| format!("{} from the tip", Length.said(units, self.length_m - x));
        let (balance, weight) = (self.balance_point_m, self.inertia_pivot_kg_m2);
        let along = |x: f64| Length.said(units, x);
        let open = |answer: Answer| about(analysis, answer, units);
        let mut facts = vec![
            fact("length_m", "Length", along(self.length_m), String::new()),
            fact(
                "mass_kg",
                "Mass",
                Mass.said(units, self.mass_kg),
                with_open(String::new(), open(Answer::Mass)),
            ),
            fact("balance_point_m", "Balance point", along(balance), from_tip(balance)),
            fact(
                "inertia_pivot_kg_m2",
                "Swing weight",
                Inertia.said(units, weight),
                with_open("about 6 in from the knob".to_owned(), open(Answer::Inertia)),
            ),
        ];
        if let Some(x) = self.center_of_percussion_m {
            let label = "Centre of percussion";
            let note = "of a pivot 6 in from the knob".to_owned();
            facts.push(fact("center_of_percussion_m", label, along(x), note));
        }
        facts
    }
}

/// A note with the uncertainty of its figure.
fn with_open(note: String, open: Option<String>) -> String {
    let open = open.map(|open| format!("{open} for the bat in hand"));
    [Some(note), open]
        .into_iter()
        .flatten()
        .filter(|part| !part.is_empty())
        .collect::<Vec<_>>()
        .join("; ")
}

fn fact(key: &'static str, label: &'static str, value: String, note: String) -> Fact {
    Fact { key, label, value, note }
}

/// Why there is no headline.
pub const NO_HIT: &str = "There is no sweet spot to show: in this scene ball and bat do not meet, or the model has no \
     solution.";
