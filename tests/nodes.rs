//! Nodes where a mode hardly moves: between stiff springs, in thick parts next to thin ones, near a pointed end.
//!
//! The truths are a theorem on oscillation and the multiprecision reference of `search/reference.py`, which has no code
//! in common with the program.

use std::path::Path;

use sweetspot::{Bat, Mode, Request, Solution, Theory, solve};

fn from_json(profile: &str, rest: &str) -> Bat {
    let text =
        format!(r#"{{ "format": "sweetspot-bat/1", "name": "t", "profile": {profile}, {rest} }}"#);
    Bat::from_text("bat.json", &text, Path::new("")).unwrap()
}

fn solved(bat: &Bat, modes: usize, tolerance: f64, theory: Theory) -> Solution {
    solve(bat, &Request { modes, tolerance, theory, ..Request::plain() }).unwrap()
}

/// Every listed node is a true one within three times its error, and every true one is listed or on a stretch for which
/// the mode says that nodes cannot be located.
fn assert_told(mode: &Mode, exact: &[f64]) {
    let told = format!("{:?} within {:.1e}, {:?}", mode.nodes, mode.error.nodes, mode.untold);
    let near = |x: f64, y: f64| (x - y).abs() <= 3.0 * mode.error.nodes + 1e-12;
    let mut left = exact.to_vec();
    for node in &mode.nodes {
        let at = left.iter().position(|x| near(*x, *node));
        left.remove(at.unwrap_or_else(|| panic!("{node} is no node of {exact:?}: {told}")));
    }
    for x in left {
        assert!(mode.untold.iter().any(|[a, b]| *a <= x && x <= *b), "{x} is missing: {told}");
    }
}

/// Mode n of a free Euler-Bernoulli bat has n + 1 nodes (Gantmacher and Krein, Oscillation Matrices, 1950). A sign
/// change in the last nanometre of a point, where the shape is below its error, is not one of them.
#[test]
fn a_pointed_end_has_no_node_that_the_theory_of_oscillation_does_not_know() {
    for power in ["0.7", "1", "1.2"] {
        for formula in [format!("0.03*x^{power}"), format!("0.03*(0.84-x)^{power}")] {
            let profile =
                format!(r#"{{ "pieces": [{{ "from": 0, "to": 0.84, "formula": "{formula}" }}] }}"#);
            let bat =
                from_json(&profile, r#""material": { "density": 700, "youngs_modulus": 15e9 }"#);
            let found = solved(&bat, 5, 1e-4, Theory::EulerBernoulli);
            for mode in &found.modes {
                assert_eq!(
                    mode.nodes.len(),
                    mode.order + 1,
                    "{formula}, {}: {:?}",
                    mode.order,
                    mode.nodes
                );
            }
        }
    }
}

/// A reversed bat is the same bat. Near the tip a formula in the distance from there has fewer digits than one in the
/// distance from the knob has near the knob, which changes neither mass nor stiffness.
#[test]
fn a_point_at_the_tip_is_solved_as_one_at_the_knob() {
    let of = |formula: &str| {
        let profile =
            format!(r#"{{ "pieces": [{{ "from": 0, "to": 0.84, "formula": "{formula}" }}] }}"#);
        let bat = from_json(&profile, r#""material": { "density": 700, "youngs_modulus": 15e9 }"#);
        solved(&bat, 3, 1e-6, Theory::EulerBernoulli)
    };
    for power in ["0.9", "1.02"] {
        let knob = of(&format!("0.03*x^{power}"));
        let tip = of(&format!("0.03*(0.84-x)^{power}"));
        assert!(knob.met() && tip.met());
        for (a, b) in knob.modes.iter().zip(&tip.modes) {
            let (error, of_other) = (a.error.total(), b.error.total());
            assert!((a.omega / b.omega - 1.0).abs() <= 3.0 * (error + of_other), "{power}");
            assert!(of_other <= 10.0 * error, "{power}: {error:.1e} {of_other:.1e}");
            for (x, y) in a.nodes.iter().zip(b.nodes.iter().rev()) {
                let known = 3.0 * (a.error.nodes + b.error.nodes);
                assert!((x + y - 0.84).abs() <= known, "{power}: {x} {y}");
            }
        }
    }
}

/// Between stiff springs a slow mode moves by 1e-12 of its largest deflection; its node there is where the
/// multiprecision reference finds it.
#[test]
fn a_node_between_stiff_springs_is_where_it_is() {
    let profile = r#"{ "interpolation": "constant", "x": [0.0, 0.02389804820704802, 0.024718345908315925,
        0.03755342967745178, 0.039428770717069746, 0.17439937606544514, 0.20156887262506568, 0.22525804737099434,
        0.3006416620650825, 0.3155903390447765, 0.38711071797842583, 0.4506410204897379, 0.4511639878812712,
        0.46591936657600824, 0.5532523645912276, 0.6117159994137146, 0.6377457921866232, 0.6603106639175421,
        0.7366395172667378, 0.7592529504010866, 0.7896173469373302],
        "radius": [0.07138750755683758, 0.12645366368854544, 0.08781680744309676, 0.010866907029971892,
        0.10618939288857561, 0.07537410172786134, 0.014194483902326374, 0.06698588402198159, 0.010375265586176177,
        0.04233039917651099, 0.10906918415015132, 0.06307714082487269, 0.01437175976414291, 0.030455631119510877,
        0.017009410072021593, 0.006068641343479667, 0.1378159331298869, 0.02062996810798786, 0.018060109092593323,
        0.04004655785778233, 0.04004655785778233] }"#;
    let rest = r#""material": {"density": 421.54482532717753, "youngs_modulus": 15586714049.111145, "shear_modulus":
        1971657191.6751356},
        "attachments": [{"x": 0.06096279295055563, "stiffness": 24095722809.605385, "rotational_stiffness":
        8472803.509728631}, {"x": 0.26161820248054307, "stiffness": 34415611.05119737}, {"x":
        0.5230406747058444, "stiffness": 30038800.636552803}, {"x": 0.6645370578552996, "stiffness":
        0.02486648910518066}],
        "joints": [{"x": 0.11716542310358438, "rotational_stiffness": 0.17446598897060897}, {"x":
        0.6543066194291159, "rotational_stiffness": 0.0017427800893309224}]"#;
    let found = solved(&from_json(profile, rest), 3, 1e-9, Theory::Timoshenko);
    assert_told(&found.modes[0], &[0.0547063138, 0.2295737709, 0.5108102886]);
    assert!(found.modes[0].error.nodes < 1e-3, "{}", found.modes[0].error.nodes);
}

/// Thick parts on a thin one, which lets them be nearly at rest.
#[test]
fn nodes_where_a_mode_hardly_moves_are_told_or_said_to_be_untold() {
    let profile = r#"{ "interpolation": "constant", "x": [0.0, 0.033182433611968674, 0.04133269675383861,
        0.09661723374940036, 0.1448222505150271, 0.23531412819122954, 0.29357797452790685, 0.346936642435874,
        0.3858899711670454, 0.41365625152768176, 0.6548741324425639, 0.7407558914543108, 0.7779320540938985,
        0.7958693932909733, 0.7973792462947212, 0.84],
        "radius": [0.006684263011999406, 0.02620924800987567, 0.12493134695723118, 0.0067369969712199555,
        0.008185494945116762, 0.01494254037022537, 0.051111084514294, 0.06389106725530298, 0.008692477353878557,
        0.009656775490477155, 0.01854782112134016, 0.1327724126230862, 0.012350106806543495, 0.042736246082438645,
        0.10104077276510892, 0.005452733592439222] }"#;
    let rest = r#""material": { "density": 700, "youngs_modulus": 15e9, "poisson_ratio": 0.08 }"#;
    let found = solved(&from_json(profile, rest), 8, 1e-3, Theory::Rayleigh);
    assert_told(
        &found.modes[6],
        &[0.0990972257, 0.3018610696, 0.395147973, 0.5373857528, 0.7263578468],
    );
    let last = [0.0988247774, 0.2669282886, 0.356360231, 0.4386791613, 0.5564176075, 0.7281347975];
    assert_told(&found.modes[7], &last);
    let profile = r#"{ "interpolation": "constant", "x": [0.0, 0.1613170779772249, 0.33964733831328153,
        0.3598042649605789, 0.3616264925850221, 0.39423940293582543, 0.5864827898779017, 0.706138444300632,
        0.7073831305639771, 0.7791627354318731, 0.7803637493650617, 0.8382],
        "radius": [0.009157425639479645, 0.10953255578915526, 0.1377425957132533, 0.017081983827710763,
        0.12708427356532878, 0.06925898342235773, 0.008416883910164753, 0.005334394628941504, 0.13597085109557752,
        0.05924202604179866, 0.04937189448662784, 0.04843512678934141] }"#;
    let rest = r#""material": { "density": 708.232711433324, "youngs_modulus": 15028974145.727488,
        "poisson_ratio": 0.07742933781754913 }, "attachments": [ { "x": 0.6601912974728003,
        "stiffness": 394853373378.7232, "rotational_stiffness": 1025751.2932976568 } ]"#;
    let found = solved(&from_json(profile, rest), 10, 1e-3, Theory::Timoshenko);
    let fifth = [0.1525031922, 0.3876727445, 0.6602772837, 0.6892580506];
    assert_told(&found.modes[4], &fifth);
    let ninth = [
        0.0223270856,
        0.0835536297,
        0.193939769,
        0.3599983646,
        0.5758152981,
        0.6603283283,
        0.7072899432,
    ];
    assert_told(&found.modes[8], &ninth);
    let tenth = [
        0.0214977885,
        0.0805895447,
        0.1611948817,
        0.2302077001,
        0.3605198321,
        0.5623730967,
        0.660328819,
        0.7073069115,
    ];
    assert_told(&found.modes[9], &tenth);
}

/// Two weights of tonnes, 30 cm off the ends. Removing the rigid motions leaves one part in 10⁴ of their motion, and
/// loses as many digits. Frequency 5 by the multiprecision reference.
#[test]
fn frequencies_with_far_weights_are_known_as_well_as_stated() {
    let profile = r#"{ "interpolation": "pchip", "x": [0, 0.1, 0.3, 0.5, 0.7, 0.84],
        "radius": [0.02, 0.012, 0.014, 0.022, 0.032, 0.033] }"#;
    let rest = r#""material": { "density": 700, "youngs_modulus": 15e9, "shear_modulus": 1e9 },
        "attachments": [
            { "x": 0, "mass": 3743.501240889072, "rotary_inertia": 0.00013868264808062446,
              "offset": -0.35305021019509353 },
            { "x": 0.84, "mass": 2146.0957719358635, "rotary_inertia": 0.0010151339737605293,
              "offset": 0.2945862626563499 } ]"#;
    for tolerance in [1e-9, 1e-11, 1e-12] {
        let found = solved(&from_json(profile, rest), 6, tolerance, Theory::Rayleigh);
        let mode = &found.modes[4];
        let off = (mode.frequency() / 1693.3590709740884 - 1.0).abs();
        assert!(off <= 3.0 * mode.error.total(), "{off:.1e} {:.1e}", mode.error.total());
    }
}

/// An unsolvable bat is refused with its reason, and not reported as a fault of the program.
#[test]
fn a_point_that_is_too_thin_for_numbers_is_solved_or_refused_with_the_reason() {
    for formula in ["0.03*x^1.75", "0.03*x^1.9", "0.03*(0.84-x)^1.75"] {
        let profile =
            format!(r#"{{ "pieces": [{{ "from": 0, "to": 0.84, "formula": "{formula}" }}] }}"#);
        let bat = from_json(&profile, r#""material": { "density": 700, "youngs_modulus": 15e9 }"#);
        let request = Request { modes: 5, theory: Theory::EulerBernoulli, ..Request::plain() };
        match solve(&bat, &request) {
            Ok(found) => assert!(found.met() || !found.ending.to_string().is_empty()),
            Err(error) => assert!(error.to_string().contains("thinnest"), "{formula}: {error}"),
        }
    }
}
