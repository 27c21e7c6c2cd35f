//! The moving parts of the page: stages and controls, which the script operates.

use std::fmt::Write;

use crate::analysis::Analysis;
use crate::page::barrel::moving;
use crate::page::data::MOVING;
use crate::page::moment::Moment;
use crate::parts::escape::html as escaped;
use crate::parts::fixed;
use sweetspot::modes::hoop::HoopMode;
use sweetspot::motion::sound::Sound;
use sweetspot_study::trampoline::barrel::Barrel;

const NO_SCRIPT: &str = "<noscript><p class=\"missing\">What moves here needs JavaScript; everything \
                         else on this page does without.</p></noscript>\n";

/// The bat bending in one of its modes.
pub fn modes(analysis: &Analysis) -> String {
    let modes = analysis.solution.modes.iter().take(MOVING);
    let names = modes.map(|mode| format!("{} · {} Hz", mode.order, fixed(mode.frequency(), 0)));
    let names: Vec<String> = names.collect();
    let choice = choice("mode", "Mode", &names, 0);
    let note = "The bending is drawn much larger and slower than it is; dots are the nodes, which \
                stay at rest.";
    player("modes-player", "The bat bending in the chosen mode", &choice, ["knob", "tip", note])
}

/// The barrel in one of its hoop modes.
pub fn hoop(barrel: &Barrel) -> String {
    let name = |(_, mode): &(usize, &HoopMode)| {
        let hertz = fixed(mode.frequency_hz, 0);
        format!("n {}, m {} · {hertz} Hz", mode.harmonic, mode.order)
    };
    let names: Vec<String> = moving(barrel).iter().map(name).collect();
    let choice = choice("hoop", "Hoop mode", &names, 0);
    let note = "The barrel from the side, and from the tip where it moves most; the motion is drawn much \
                larger and slower than it is.";
    let told = ["from the side", "from the tip", note];
    player("hoop-player", "The barrel ringing in the chosen mode", &choice, told)
}

/// Ball and bat at the moment of the hit.
pub fn moment(moments: &[Moment]) -> String {
    let names: Vec<String> = moments.iter().map(|moment| moment.label.clone()).collect();
    let choice = choice("moment", "The ball is hit", &names, 0);
    let factor = moments.first().map_or(1, |moment| moment.factor);
    let note = format!(
        "Seen by someone who moves with the bat, which swings upwards. Ball, flight and squeeze are to \
         scale; the bat's bending about the ball is drawn {factor} times larger than it is, in both hits."
    );
    let told = ["knob", "tip", &note];
    player("moment-player", "Ball and bat at the moment of the hit", &choice, told)
}

/// Buttons that play the sounds of the bat.
pub fn sounds(tap: &Sound, hit: Option<&Sound>, damping: Option<String>) -> String {
    if tap.tones.is_empty() {
        return String::new();
    }
    let button = |key: &str, words: &str| {
        format!("<button type=\"button\" class=\"hear\" data-sound=\"{key}\">{words}</button>\n")
    };
    let hit = hit.map_or(String::new(), |_| button("hit", "Hear the hit"));
    let damping = damping.map_or(String::new(), |told| format!(" Damping: {told}."));
    format!(
        "<div class=\"sounds moving\">\n<div class=\"controls\">\n{hit}{}</div>\n\
         <p class=\"remark\">The modes of the bat and of a hollow barrel's wall, as they ring and die out where it is struck.{damping}</p>\n\
         </div>\n",
        button("tap", "Hear a tap on the tip")
    )
}

/// Buttons of which one is selected, at first the given one.
pub fn choice(name: &str, legend: &str, labels: &[String], first: usize) -> String {
    let mut out =
        format!("<fieldset class=\"choice {name}\"><legend>{}</legend>\n", escaped(legend));
    for (k, label) in labels.iter().enumerate() {
        let checked = if k == first { " checked" } else { "" };
        let _ = writeln!(
            out,
            "<label><input type=\"radio\" name=\"{name}\" id=\"{name}-{k}\" value=\"{k}\"{checked}>\
             <span>{}</span></label>",
            escaped(label)
        );
    }
    out + "</fieldset>\n"
}

/// A stage with its controls.
fn player(id: &str, title: &str, choice: &str, [from, to, note]: [&str; 3]) -> String {
    let title = escaped(title);
    format!(
        "{NO_SCRIPT}<div class=\"player moving\" id=\"{id}\">\n{choice}\
         <svg class=\"stage\" role=\"img\" aria-label=\"{title}\"></svg>\n\
         <p class=\"ends\" aria-hidden=\"true\"><span>{from}</span><span>{to}</span></p>\n\
         <div class=\"controls\">\n\
         <button type=\"button\" class=\"play\" aria-pressed=\"false\">Play</button>\n\
         <button type=\"button\" class=\"slow\" aria-pressed=\"false\">Slow</button>\n\
         <label class=\"scrub\"><span>Time</span>\
         <input type=\"range\" min=\"0\" max=\"1000\" value=\"0\"></label>\n</div>\n\
         <p class=\"now\"></p>\n<p class=\"remark\">{}</p>\n</div>\n",
        escaped(note)
    )
}

/// The slider of a hair-line that reads a picture off, by pointer and by keyboard.
pub fn hair_line(name: &str) -> String {
    let of = escaped(&name.replace('_', " "));
    format!(
        "<div class=\"moving hair\">\n<input type=\"range\" min=\"0\" max=\"1000\" value=\"0\" step=\"any\" \
         aria-label=\"Position along the barrel: {of}\">\n</div>\n"
    )
}

/// Where the read-off values appear.
pub const READING: &str = "<p class=\"moving reading\" aria-live=\"polite\"></p>\n";
