//! The moment of the hit in the report: ball and bat move as the contact computes.

use sweetspot::bat::theory::Theory;
use sweetspot::collision::hit::{Model, Scene, Wall};
use sweetspot::collision::hitter::Hitter;
use sweetspot::{Bat, Request, solve};
use sweetspot_report::analysis::{Analysis, Task};
use sweetspot_report::page::content::Report;
use sweetspot_report::page::moment::Moment;

fn mesh(name: &str) -> String {
    format!("{}/meshes/{name}.json", env!("SWEETSPOT_TOP"))
}

fn analysed(bat: Bat, scene: Scene) -> Analysis {
    let hits = Request { theory: Theory::Timoshenko, ..Request::default() };
    let solution = solve(&bat, &hits).unwrap();
    let (model, proof, readings) = (Model::Contact, Request::plain(), Default::default());
    let task = Task { model, scene, law: None, hits, proof, readings };
    Analysis::new(bat, solution, task).unwrap()
}

/// The law of the ball, F = k uᵅ at first, gives its compression for every force shown; a compliant wall of the barrel
/// deforms in addition.
#[test]
fn the_ball_is_squeezed_as_much_as_its_force_needs() {
    let wall = |mass| Some(Wall { stiffness: 1e7, mass });
    let scenes = [("r161", None), ("northwestern_aluminium", wall(0.05)), ("torpedo", wall(0.0))];
    for (name, wall) in scenes {
        let scene = Scene { wall, ..Scene::default() };
        let analysis = analysed(Bat::from_file(mesh(name)).unwrap(), scene);
        let report = Report::new(&analysis, String::new(), vec![], None).unwrap();
        let Analysis { bat, task, hits, .. } = &analysis;
        let hitter =
            Hitter::new(task.model, &task.scene, bat, &hits.solution, hits.effort).unwrap();
        assert_eq!(report.moments.len(), 2);
        for moment in &report.moments {
            let outcome = hitter.strike(moment.x_m).outcome.unwrap();
            let most = 1e-3 * outcome.peak_force.unwrap();
            assert!(moment.force_kn.iter().all(|force| *force <= most + 0.006), "{name}");
            assert!((moment.contact_ms - 1e3 * outcome.contact_time.unwrap()).abs() < 1e-3);
            follows_the_law(&task.scene, moment);
            parts_evenly(moment);
        }
        assert!(report.page().len() < 700_000);
        // Hits on one page have the same enlargement, so that their bending can be compared.
        assert_eq!(report.moments[0].factor, report.moments[1].factor);
    }
}

/// Until the force first falls, the compression of the ball follows its law; the last instant before may already be
/// part of the expansion.
fn follows_the_law(scene: &Scene, moment: &Moment) {
    let [k, alpha] = [scene.ball.stiffness, scene.ball.exponent].map(Option::unwrap);
    let falls = moment.force_kn.windows(2).position(|pair| pair[1] < pair[0]).unwrap();
    let mut seen = 0;
    for (force, gap) in moment.force_kn[..falls].iter().zip(&moment.gap_mm) {
        if *force < 1.0 {
            continue;
        }
        let squeezed = |force: f64| 1e3 * (1e3 * force / k).powf(1.0 / alpha);
        // Both are given to a hundredth.
        let rounding = 0.005 + squeezed(force + 0.005) - squeezed(*force);
        assert!((squeezed(*force) + gap).abs() < 0.01 + rounding, "{force} kN, {gap} mm");
        seen += 1;
    }
    assert!(seen > 3, "{seen}");
}

/// Before and after the contact the ball is off the bat, and nothing jumps at the separation.
fn parts_evenly(moment: &Moment) {
    let Moment { times_ms, gap_mm, force_kn, contact_ms, bending_10_um, .. } = moment;
    let last = times_ms.len() - 1;
    assert!(gap_mm[0] > 0.0 && gap_mm[last] > 0.0 && force_kn[last] == 0.0);
    let gone = times_ms.partition_point(|time| time <= contact_ms);
    assert!(gap_mm[gone] > 0.0 && gap_mm[gone - 1] < 0.01, "{:?}", &gap_mm[gone - 1..=gone]);
    for three in gap_mm[gone - 2..gone + 3].windows(3) {
        let bend = three[0] - 2.0 * three[1] + three[2];
        assert!(bend.abs() < 1.0, "{three:?}");
    }
    // In the frame of the bat as a whole, bending neither moves nor rotates its mass: it is at rest before the contact,
    // and bends to both sides after it.
    assert!(bending_10_um[0].iter().all(|w| *w == 0));
    let all = || bending_10_um[last].iter();
    assert!(all().any(|w| *w > 0) && all().any(|w| *w < 0));
}
