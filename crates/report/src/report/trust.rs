//! The answers on one screen, each with its uncertainty for this bat, and the reasons.

use schemars::JsonSchema;
use serde::Serialize;

use crate::analysis::Analysis;
use crate::parts::cell::two_digits;
use crate::parts::{Columns, Quantity, Units, WIDE, first, wrapped};
use crate::report::text::edited;
use sweetspot::base::number::{bound, percent, significant};
use sweetspot::bat::material::Scatter;
use sweetspot::collision::Model;
use sweetspot::collision::figures::BarrelSpeed;
use sweetspot::{Bat, Material, Mode};
use sweetspot_study::answers::Answer;
use sweetspot_study::read_to::diameters_read_to;
use sweetspot_study::spread::{Input, Source, Spread, of_frequencies};
use sweetspot_study::verdict::{Doubt, Verdict};

/// The bat, the answers and their reliability.
pub fn screen(analysis: &Analysis, units: Units) -> [String; 2] {
    let name = analysis.bat.title();
    let mut out = format!("{}\n", name.chars().take(WIDE).collect::<String>());
    out += &edited(&analysis.bat, units);
    out += &wrapped(&scene(analysis, units), 2);
    [out + &table(analysis, units), reasons(analysis, units)]
}

/// The sweet spot in a sentence, with the doubts about it.
pub fn in_short(analysis: &Analysis, units: Units) -> String {
    let Analysis { bat, spread, task, verdict, .. } = analysis;
    let [Some(place), Some(speed)] =
        [Answer::ExitSpeedPlace, Answer::ExitSpeed].map(|of| spread.of(of))
    else {
        return "Sweet spot: ball and bat do not meet.\n".to_owned();
    };
    let open = |answer: Answer| {
        about(analysis, answer, units).map_or(String::new(), |open| format!(", {open},"))
    };
    let shown = |kind: Quantity, value: f64| kind.said(units, value);
    let told = format!(
        "Sweet spot: {} from the knob{} {} from the tip; there the ball leaves at {}{} after a swing of {} and a \
         pitch of {}.",
        shown(Quantity::Length, place.value),
        open(Answer::ExitSpeedPlace),
        shown(Quantity::Length, bat.length() - place.value),
        shown(Quantity::Speed, speed.value),
        open(Answer::ExitSpeed),
        shown(Quantity::Speed, BarrelSpeed::of(bat, &task.scene, BarrelSpeed::BROADCAST).speed),
        shown(Quantity::Speed, task.scene.ball_speed)
    );
    [told].into_iter().chain(doubts(verdict, units)).map(|text| wrapped(&text, 0)).collect()
}

/// The answers and their reliability, as part of a longer text.
pub fn text(analysis: &Analysis, units: Units) -> String {
    format!("\nAnswers\n{}{}\n", table(analysis, units), reasons(analysis, units))
}

fn reasons(analysis: &Analysis, units: Units) -> String {
    let told = trust(analysis, units);
    let lines = told.iter().map(|text| wrapped(&format!("  {text}"), 2));
    format!("How far to trust it\n{}", lines.collect::<String>())
}

/// The hit in a line.
fn scene(analysis: &Analysis, units: Units) -> String {
    let (bat, scene) = (&analysis.bat, &analysis.task.scene);
    let barrel = BarrelSpeed::of(bat, scene, BarrelSpeed::BROADCAST);
    let model = match analysis.task.model {
        Model::Contact => String::new(),
        other => format!("; model {}", other.name()),
    };
    format!(
        "  {}; swing {}, pitch {}{model}",
        Quantity::Length.said(units, bat.length()),
        Quantity::Speed.said(units, barrel.speed),
        Quantity::Speed.said(units, scene.ball_speed)
    )
}

/// The cause of the uncertainty of an answer, in a word.
pub fn word(source: &Source) -> &'static str {
    match source.input {
        Input::Diameters => "diameters",
        Input::Patch => "wall",
        Input::Length => "rule",
        Input::Mass => "scale",
        other => other.name(),
    }
}

/// The answers, their uncertainty, and its main cause.
pub fn table(analysis: &Analysis, units: Units) -> String {
    let spread = &analysis.spread;
    let head =
        if spread.sources.is_empty() { [""; 2] } else { ["± (two bats in three)", "most by"] };
    let columns =
        Columns::new([first(15, ""), first(28, "computed"), first(28, head[0]), first(9, head[1])]);
    let mut out = columns.heads();
    let mut row = |what: &str, answer: Answer| {
        let Some(estimate) = spread.of(answer) else { return };
        let kind = Quantity::of(answer);
        let mostly = spread.mostly(answer).map_or("", |(source, _)| word(source));
        let open = about(analysis, answer, units).unwrap_or_default();
        let value = kind.said(units, estimate.value);
        out += &columns.row([&format!("  {what}"), &value, &open, mostly]);
        if answer == Answer::ExitSpeedPlace {
            let tip = kind.said(units, analysis.bat.length() - estimate.value);
            out += &columns.row(["    from tip", &tip, "", ""]);
        }
    };
    row("sweet spot", Answer::ExitSpeedPlace);
    row("fastest ball", Answer::ExitSpeed);
    // Near a later contact the exit speed changes within a millimetre.
    if !analysis.verdict.doubts.contains(&Doubt::LaterContact) {
        row("1 % less at", Answer::Zone(false));
        row("     and at", Answer::Zone(true));
    }
    row("swing weight", Answer::Inertia);
    row("mass", Answer::Mass);
    row("f1", Answer::Frequency(1));
    row("f2", Answer::Frequency(2));
    row("f3", Answer::Frequency(3));
    out
}

/// The reliability of the answers: the bat first, what would reduce its uncertainty, then the computation.
pub fn trust(analysis: &Analysis, units: Units) -> Vec<String> {
    let mut told = of_bat(analysis, units);
    told.push(computation(analysis));
    told
}

/// The uncertainty of this bat, the doubts, and what would reduce it.
pub fn of_bat(analysis: &Analysis, units: Units) -> Vec<String> {
    let doubts = doubts(&analysis.verdict, units);
    let failed = analysis.failed.iter().map(|text| format!("{text}."));
    let bat = [bat_first(analysis, units)].into_iter().chain(doubts).chain(failed);
    bat.chain(settled_by(analysis, units)).collect()
}

/// The doubts about a hit, one sentence each.
pub fn doubts(verdict: &Verdict, units: Units) -> Vec<String> {
    verdict.doubts.iter().map(|doubt| doubted(doubt, units)).collect()
}

/// A doubt in a sentence.
fn doubted(doubt: &Doubt, units: Units) -> String {
    match doubt {
        Doubt::Density(text) => format!("Look at the file: {text}"),
        Doubt::Shear(text) => format!("Shear is left out: {text}."),
        Doubt::Dent(wall, held) => {
            let us = units.us_first();
            let scale = Quantity::Small.scale(us);
            let [low, high] = wall.bbcor.range;
            format!(
                "The wall dents by {} of its {}: beyond half of it this theory ends; the ball's figures are \
                 rough, {}BBCOR {:.3} ({:.3} stiff; {low:.3} to {high:.3}).",
                scale.value(wall.dent_m),
                scale.text(wall.thickness_m),
                if *held { "" } else { "free " },
                wall.bbcor.with,
                wall.bbcor.stiff
            )
        }
        Doubt::RigidWall(_) => {
            "Left out: how the hollow barrel's wall gives way, which lets the ball leave faster."
                .to_owned()
        }
        Doubt::LaterContact => {
            "The fastest ball is struck again as it leaves: small changes move that far.".to_owned()
        }
        Doubt::BallLaw => {
            "Beyond the ball's measured law: over 2 ms in touch, under 0.44 returned, or pressed harder than by a \
             rigid wall at 80 m/s."
                .to_owned()
        }
        Doubt::ExitSpeeds { error } => format!(
            "Exit speeds are less accurate than was asked: the worst within {} of the closing speed.",
            bound(*error, 2)
        ),
    }
}

/// The uncertainty of an answer for this bat, `± 0.54 cm`; None where there is none. The uncertainty of the effects on
/// the ball is larger where the wall is beyond its theory or neglected, and that of everything where the bat differs
/// from its file.
pub fn about(analysis: &Analysis, answer: Answer, units: Units) -> Option<String> {
    let spread = &analysis.spread;
    spread.mostly(answer)?;
    let deviation = spread.of(answer)?.deviation?;
    // A jump has no slope.
    if answer == Answer::ExitSpeedPlace && analysis.verdict.doubts.contains(&Doubt::LaterContact) {
        return Some("may jump far".to_owned());
    }
    let of_ball =
        [Answer::ExitSpeedPlace, Answer::ExitSpeed, Answer::Zone(false), Answer::Zone(true)];
    let ball = analysis.verdict.ball_is_open() && of_ball.contains(&answer);
    let stiff = [Answer::Mass, Answer::BalancePoint, Answer::Inertia].contains(&answer);
    let bent = analysis.verdict.bending_is_open() && !stiff;
    let more = ball || bent || analysis.verdict.bat_is_open();
    // A lower limit is shown in one unit.
    let (more, units) = if more { (" or more", units.first()) } else { ("", units) };
    Some(format!("± {}{more}", Quantity::of(answer).about(units, deviation)))
}

/// The uncertainty of the bat, and the resulting one of its first frequency.
fn bat_first(analysis: &Analysis, units: Units) -> String {
    let Analysis { bat, spread, .. } = analysis;
    let mut told: Vec<String> = vec![];
    let find = |input: Input| spread.sources.iter().find(|source| source.input == input);
    let share = |source: &Source| format!("{} %", significant(100.0 * source.deviation, 2));
    told.extend(materials(bat, spread));
    let length = |source: &Source| Quantity::Small.about(units.first(), source.deviation);
    let readings = match (diameters_read_to(bat), bat.profile().formulas.is_some()) {
        // Unless calipers with another error were given.
        (Some(read), _)
            if Some(read.deviation()) == find(Input::Diameters).map(|of| of.deviation) =>
        {
            format!("diameters read to {} are off by", read.name)
        }
        (_, true) => "bats are made to a formula within".to_owned(),
        _ => "calipers are off by".to_owned(),
    };
    let times = |source: &Source| significant(source.deviation.exp(), 2);
    let read = [
        (Input::Diameters, &*readings, &length as &dyn Fn(&Source) -> String),
        (Input::Length, "a rule by", &length),
        (Input::Mass, "a scale by", &|source| {
            Quantity::Mass.about(units.first(), source.deviation)
        }),
        (Input::Tap, "a tapped note by", &share),
        (Input::Patch, "the ball's patch by a factor of", &times),
    ];
    let read = read.into_iter().filter_map(|(input, what, size)| {
        find(input).map(|source| format!("{what} {}", size(source)))
    });
    told.extend(read);
    let left_out = match &spread.left_out[..] {
        [] => String::new(),
        [one] => format!(" Not counted: {one}."),
        [one, others @ ..] => format!(" Not counted: {one}; {} more in the JSON.", others.len()),
    };
    if told.is_empty() {
        return format!("The bat first: nothing of it was counted as open.{left_out}");
    }
    let range = spread.of(Answer::Frequency(1)).and_then(|open| Some((open.value, open.range()?)));
    let range = range.map_or(String::new(), |(value, [low, high])| {
        let digits = two_digits(0.5 * (high - low));
        format!(
            "; f1, {value:.1} Hz here, is {low:.digits$} to {high:.digits$} Hz in two bats of three"
        )
    });
    format!("The bat first: {}{range}.{left_out}", told.join(", "))
}

/// The scatter of the materials of the bat, a phrase for wood and one for metals.
fn materials(bat: &Bat, spread: &Spread) -> Vec<String> {
    let all: Vec<&Material> = bat.layups().iter().flat_map(|layup| layup.materials()).collect();
    let wood = all.iter().find_map(|material| material.scatter());
    let metal = all.iter().filter(|material| material.is_metal());
    let metal = metal.filter_map(|material| material.differs()).next();
    let told = |(kind, scatter): (&str, Option<Scatter>)| {
        let Scatter { youngs_modulus, density, .. } = scatter?;
        let of =
            [(Input::Stiffness, youngs_modulus, "stiffness"), (Input::Density, density, "density")];
        let open = of.into_iter().filter(|(input, size, _)| {
            spread.sources.iter().any(|source| source.input == *input && source.deviation == *size)
        });
        let open: Vec<String> = open
            .map(|(_, size, what)| format!("{} % in {what}", significant(100.0 * size, 2)))
            .collect();
        (!open.is_empty()).then(|| format!("{kind} by {}", open.join(" and ")))
    };
    let kinds = [("clear wood of one kind differs", wood), ("alloys differ", metal)];
    kinds.into_iter().filter_map(told).collect()
}

/// What would remove most of the uncertainty: a tap or a scale, where one would.
fn settled_by(analysis: &Analysis, units: Units) -> Option<String> {
    /// From this share of the variance on, a tap is worthwhile.
    const MOST: f64 = 0.5;
    let Analysis { bat, solution, spread, task, .. } = analysis;
    let by = |answer: Answer, input: Input| {
        spread.mostly(answer).is_some_and(|(of, share)| of.input == input && share > MOST)
    };
    // A note that is known no better than the answer does not help.
    let frequency = spread.of(Answer::Frequency(1));
    let open = frequency.and_then(|of| Some(of.deviation? / of.value)).unwrap_or(0.0);
    if by(Answer::Frequency(1), Input::Stiffness) && open > 2.0 * task.readings.tap {
        let known = percent(task.readings.tap, 0);
        let free = bat.fixtures().rigid_modes() == 2;
        let node = solution.modes.first().and_then(|mode| mode.nodes.first()).filter(|_| free);
        let hold = node.map_or("Tap it".to_owned(), |x| {
            format!("Tap it, held loosely {} from the knob", Quantity::Length.said(units, *x))
        });
        return Some(format!(
            "{hold}, type the note into its file, \"weighed\": {{ \"first_bending_hz\": ... }}, and f1 is \
             known to {known}."
        ));
    }
    by(Answer::Mass, Input::Density).then(|| {
        let known = Quantity::Mass.about(units, task.readings.mass);
        format!(
            "Weigh it, type the \"mass\" into \"weighed\" of its file, and it is known to {known}."
        )
    })
}

/// The error of the computation.
fn computation(analysis: &Analysis) -> String {
    let Analysis { solution, hits, .. } = analysis;
    let mut told = vec![];
    let shown = solution.modes.iter().take(3).map(|mode| mode.error.total());
    if let Some(worst) = shown.reduce(f64::max) {
        told.push(format!("frequencies within {}", bound(worst, 1)));
    }
    if let Some((_, outcome)) = hits.worst() {
        told.push(format!("exit speeds within {}", bound(outcome.error, 1)));
    }
    let asked = analysis.task.hits.tolerance;
    let verdict = match (analysis.task.hits.elements, solution.met() && hits.met()) {
        (None, true) if far_more_exact(analysis) => " itself is far more exact than that",
        (None, true) => "",
        (None, false) => &format!(" was asked within {asked:.0e}, NOT met"),
        (Some(_), _) => ", with the elements that were asked for",
    };
    let told =
        if told.is_empty() { "masses and lengths are exact".to_owned() } else { told.join(", ") };
    // Where there are doubts, the reference of the error is omitted.
    let of = if analysis.verdict.doubts.is_empty() { " of the closing speed" } else { "" };
    let of = if told.contains("exit") { of } else { "" };
    format!("The computation{verdict}: {told}{of}.")
}

/// Whether the errors of the computation are at most a tenth of the uncertainty of every answer that has one. The
/// uncertainty of a doubtful hit is not known.
fn far_more_exact(analysis: &Analysis) -> bool {
    const SMALL: f64 = 0.1;
    let Analysis { solution, hits, spread, verdict, .. } = analysis;
    let open = |answer: Answer| {
        spread.of(answer).map(|of| of.deviation.filter(|_| !spread.sources.is_empty()))
    };
    let frequencies = [Answer::Frequency(1), Answer::Frequency(2), Answer::Frequency(3)];
    let frequency = |(answer, mode): (Answer, &Mode)| match open(answer) {
        None => true,
        Some(open) => {
            open.is_some_and(|open| mode.error.total() * mode.frequency() <= SMALL * open)
        }
    };
    let speed = match (open(Answer::ExitSpeed), hits.worst()) {
        (Some(open), Some((impact, outcome))) => {
            let closing = impact.bat_speed + analysis.task.scene.ball_speed;
            open.is_some_and(|open| outcome.error * closing <= SMALL * open)
        }
        _ => true,
    };
    verdict.doubts.is_empty()
        && !spread.sources.is_empty()
        && speed
        && frequencies.into_iter().zip(&solution.modes).all(frequency)
}

/// The uncertainty of every frequency due to the wood alone, in a line; empty if it is not known.
pub fn of_wood(bat: &Bat) -> String {
    let Some(open) = of_frequencies(bat) else { return String::new() };
    let text = format!(
        "Trust: wood differs from piece to piece, and by it every frequency by {} (one standard \
         deviation). A tapped note in the bat file settles that: \"weighed\": {{ \"first_bending_hz\" }}",
        percent(open, 0)
    );
    wrapped(&text, 7)
}

/// Where the uncertainty of a hit is shown.
pub const IN_ANALYZE: &str =
    "Trust: its uncertainty due to wood, scale and calipers: sweetspot analyze\n";

/// What is not known exactly about a bat, and the resulting uncertainty of each answer, to first order, with
/// independent sources.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Open {
    /// The sources of uncertainty and the uncertainty of each answer.
    #[serde(flatten)]
    pub spread: Spread,
    /// Reasons for which the answers are less certain than that; left out where there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub doubts: Vec<DoubtFile>,
}

/// A reason for which the answers are less certain than the computed uncertainty says.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Doubt")]
pub struct DoubtFile {
    /// The subject: the density of the material, shear that is neglected because no modulus is known, the dent in the
    /// wall of a hollow barrel, a wall that is taken as rigid, a fastest place that depends on a later contact, a hit
    /// for which the law of the ball was not measured, exit speeds that are less accurate than requested.
    #[schemars(extend("enum" = ["density", "shear", "dent", "rigid_wall", "later_contact", "ball_law", "exit_speeds"]))]
    pub about: &'static str,
    /// The doubt in a sentence.
    pub text: String,
}

/// The member `open` of the `sweetspot-analysis/1` document.
pub fn open(analysis: &Analysis) -> Open {
    Open { spread: analysis.spread.clone(), doubts: in_file(&analysis.verdict) }
}

/// The doubts about a hit, for documents.
pub fn in_file(verdict: &Verdict) -> Vec<DoubtFile> {
    let doubt = |doubt: &Doubt| DoubtFile {
        about: doubt.about(),
        text: match doubt {
            Doubt::RigidWall(why) => why.clone(),
            other => doubted(other, Units::Si),
        },
    };
    verdict.doubts.iter().map(doubt).collect()
}
