//! How are fixtures, supports and measured values of a bat written in a file?

use crate::base::{Mistakes, Result, mistakes};
use crate::bat::part::Part;
use crate::bat::{Fixtures, Held, Layup, Material, Region, Support, Weighed};
use crate::files::json_node::Object;
use crate::files::part_file;

/// The bat under a fixture: its material, and its length (m) if that could be read.
pub(crate) struct On<'a> {
    pub material: &'a Material,
    pub length: Option<f64>,
}

/// The fixtures of a bat file.
pub(crate) fn read(root: &Object, on: &On, mistakes: &mut Mistakes) -> Fixtures {
    let region = || Region { from: 0.0, to: 0.0, layup: Layup::of(on.material.clone()) };
    let support = || Support { x: 0.0, kind: Held::Pinned };
    let grip = root.get("grip").map(|node| part_file::part(node, Default::default(), on.length));
    Fixtures {
        regions: mistakes.note(list(root, "regions", region, on.length)),
        attachments: mistakes.note(list(root, "attachments", Default::default, on.length)),
        tapes: mistakes.note(list(root, "tapes", Default::default, on.length)),
        absorbers: mistakes.note(list(root, "absorbers", Default::default, on.length)),
        joints: mistakes.note(list(root, "joints", Default::default, on.length)),
        supports: mistakes.note(list(root, "supports", support, on.length)),
        grip: mistakes.note(grip.transpose()),
    }
}

/// The results of weighing and tapping in a file, for a bat of that length (m).
pub(crate) fn weighed(root: &Object, length: Option<f64>) -> Result<Weighed> {
    let Some(node) = root.get("weighed") else { return Ok(Weighed::default()) };
    part_file::part(node, Weighed::default(), length)
}

/// Parts of one kind; a member that the file omits is as in `start`.
fn list<P: Part>(
    root: &Object,
    key: &str,
    start: impl Fn() -> P,
    length: Option<f64>,
) -> Result<Vec<P>> {
    /// Most parts of one kind: the work grows faster than their number, since every stretch lists all tapes on it and
    /// absorbers damp each other's motion.
    const MOST: usize = 400;
    const GROWING: [&str; 3] = ["regions", "tapes", "absorbers"];
    let Some(node) = root.get(key) else { return Ok(vec![]) };
    let items = node.items()?;
    if items.len() > MOST && GROWING.contains(&key) {
        return Err(node.error(format!("{} items", items.len()), format!("{MOST} at most")));
    }
    mistakes::all(items.iter().map(|item| part_file::part(item, start(), length)))
}
