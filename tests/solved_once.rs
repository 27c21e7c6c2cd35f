//! No bat is solved twice in the same way.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;

use sweetspot::collision::hit::{Model, Scene};
use sweetspot::collision::wall_choice::WallChoice;
use sweetspot::modes::prepared::prepare;
use sweetspot::modes::solve::SOLVED;
use sweetspot::{Bat, Request, solve};
use sweetspot_report::analysis::{Analysis, Task};

/// Only bats with this name are counted, because other tests solve theirs at the same time.
const NAME: &str = "solved once";

/// Number of times that a bat with all its properties was solved for a request.
static SEEN: Mutex<BTreeMap<(String, String), usize>> = Mutex::new(BTreeMap::new());

fn tell(bat: &Bat, request: &Request) {
    if bat.name() == NAME {
        let key = (format!("{bat:?}"), format!("{request:?}"));
        *SEEN.lock().unwrap().entry(key).or_default() += 1;
    }
}

/// Solid and hollow: theory, modes, hits, their scatter, advice and barrel. The bat itself is solved by the plain beam
/// (to choose the theory), for its modes, for its hits and for its advice, each with the accuracy needed; all other
/// solves have something changed.
#[test]
fn an_analysis_solves_no_bat_twice_in_the_same_way() {
    SOLVED.set(tell).unwrap();
    for mesh in ["r161", "bbcor_made_up"] {
        let path = format!("{}/meshes/{mesh}.json", env!("SWEETSPOT_TOP"));
        let text = std::fs::read_to_string(path).unwrap();
        let mut file: serde_json::Value = serde_json::from_str(&text).unwrap();
        file["name"] = NAME.into();
        let bat = Bat::from_text("counted.json", &file.to_string(), Path::new("")).unwrap();
        let prepared = prepare(&bat, &Request { modes: 10, ..Request::default() }).unwrap();
        let (bat, hits) = (prepared.bat.into_owned(), prepared.request);
        let scene = Scene::default();
        let scene = scene.with_wall(WallChoice::Auto, &bat, Model::Contact, Some(1e-4)).unwrap();
        let solution = solve(&bat, &hits).unwrap();
        let (proof, readings) = (Request::plain(), Default::default());
        let task = Task { model: Model::Contact, scene, law: None, hits, proof, readings };
        let same = format!("{bat:?}");
        Analysis::new(bat, solution, task).unwrap();
        let seen = std::mem::take(&mut *SEEN.lock().unwrap());
        let again: Vec<_> = seen.iter().filter(|(_, count)| **count > 1).collect();
        let own: Vec<&String> =
            seen.keys().filter(|(bat, _)| *bat == same).map(|(_, request)| request).collect();
        assert!(again.is_empty(), "{mesh}: {again:?}");
        assert!(own.len() <= 7, "{mesh}: {own:#?}");
    }
}
