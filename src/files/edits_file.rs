//! How are edits, the changes of a bat after it was weighed, written in a file?

use crate::base::{Mistakes, Quantity, Result, mistakes};
use crate::bat::part::Part;
use crate::bat::{Bore, Change, Cork, Cup, Cut, Edit, Material, ScaleDiameter, Shorten, Sleeve};
use crate::files::json_node::{Node, Object};
use crate::files::part_file;

/// The edits of a bat file, in their order.
pub(crate) fn read(root: &Object) -> Result<Vec<Edit>> {
    let Some(node) = root.get("edits") else { return Ok(vec![]) };
    mistakes::all(node.items()?.iter().map(edit))
}

fn edit(node: &Node) -> Result<Edit> {
    let mut mistakes = Mistakes::default();
    let keys: Vec<&str> = Change::VERBS.into_iter().chain(["name"]).collect();
    let object = node.object(&keys, &mut mistakes)?;
    let name = mistakes.note(object.string("name"));
    let change = object.one_of(&Change::VERBS).and_then(|found| match found {
        Some((verb, node)) => change(verb, node),
        None => {
            let verbs: Vec<String> = Change::VERBS.iter().map(|v| format!("\"{v}\"")).collect();
            Err(node.error("no change", format!("one of {}", verbs.join(", "))))
        }
    });
    mistakes.and(change.map(|change| Edit { name, change }))
}

/// A change by its name. Whether it fits the bat is checked by the bat.
fn change(verb: &str, node: &Node) -> Result<Change> {
    Ok(match verb {
        "cut" => Change::Cut(read_part(node, Cut::default())?),
        "cup" => Change::Cup(read_part(node, Cup::default())?),
        "bore" => Change::Bore(read_part(node, Bore::default())?),
        "cork" => {
            let (from, to, diameter, material) = (0.0, 0.0, 0.0, blank());
            Change::Cork(read_part(node, Cork { from, to, diameter, material })?)
        }
        "sleeve" => {
            let (from, to, thickness, material) = (0.0, 0.0, 0.0, blank());
            Change::Sleeve(read_part(node, Sleeve { from, to, thickness, material })?)
        }
        "shorten" => Change::Shorten(read_part(node, Shorten::default())?),
        "scale_diameter" => Change::ScaleDiameter(read_part(node, ScaleDiameter::default())?),
        "wood" => Change::Wood(part_file::whole_material(node)?),
        _ => Change::Knob(node.quantity(Quantity::Mass)?),
    })
}

/// A part whose places are not yet checked: earlier edits may change the length of the bat.
fn read_part<P: Part>(node: &Node, start: P) -> Result<P> {
    part_file::part(node, start, None)
}

/// A stand-in for a material that will be read.
fn blank() -> Material {
    Material::new(1.0, 1.0).expect("both are above 0")
}
