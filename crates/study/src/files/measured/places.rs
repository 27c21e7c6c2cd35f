//! Positions of the points of a measurement, for a file with shapes but without geometry.

use std::collections::BTreeMap;
use std::path::Path;

use crate::engine::{Document, Error, Quantity, Result, Sheet, units};
use crate::files::measured::is_table;
use sweetspot::files::sheet::normal;

/// Distance of every node from the knob end (m), by its label.
pub type Places = BTreeMap<i64, f64>;

/// An example of such a text.
const EXAMPLE: &str = "nodes and places such as \"1=0 in, 2=3 in\", or a CSV file of node,x_in";

/// Reads places: `1=0 in, 2=3 in`, or the name of a CSV file with the columns `node` and `x_in` (or
/// another unit).
///
/// # Errors
///
/// [`Error::Value`] for a text that is neither, a node named twice or a place that is not a length;
/// [`Error::Read`] and [`Error::Input`] for a file.
pub fn read(text: &str) -> Result<Places> {
    match text.contains('=') {
        true => typed(text),
        false if is_table(Path::new(text)) => file(Path::new(text)),
        false => Err(Error::value("--places", text, EXAMPLE)),
    }
}

fn typed(text: &str) -> Result<Places> {
    let mut pairs: Vec<String> = vec![];
    for part in text.split(',') {
        // A comma without a node after it is that of a number, as in 33,5 in.
        match pairs.last_mut().filter(|_| !part.contains('=')) {
            Some(last) => *last += &format!(",{part}"),
            None => pairs.push(part.to_owned()),
        }
    }
    let mut places = Places::new();
    for pair in pairs {
        let wrong = || Error::value("--places", pair.trim(), EXAMPLE);
        let (node, place) = pair.split_once('=').ok_or_else(wrong)?;
        let node = node.trim().parse().map_err(|_| wrong())?;
        let place = units::parse_or_si(place.trim(), Quantity::Length);
        let place = place.map_err(|wrong| {
            Error::value(format!("--places, node {node}"), wrong.found, wrong.expected)
        })?;
        if places.insert(node, place).is_some() {
            let found = format!("node {node} a second time");
            return Err(Error::value("--places", found, "every node once"));
        }
    }
    Ok(places)
}

fn file(path: &Path) -> Result<Places> {
    const FAR: f64 = 1e6;
    let document = Document::table(path)?;
    let known = |names: &[String]| names.iter().any(|name| name == "node");
    let table = Sheet::new(&document, "a header such as node,x_in", known)?;
    if table.header.cells.len() != 2 || normal(table.header.cells[0]) != "node" {
        let expected = "two columns, node and x_in (or another unit)";
        return Err(table.strange((&table.header, 0), "header", expected));
    }
    let metres = table.factor((&table.header, 1), "x", Quantity::Length)?;
    let mut places = Places::new();
    for row in &table.rows {
        let Ok(node) = row.cells[0].parse() else {
            return Err(table.strange((row, 0), "node", "the label of a node, a whole number"));
        };
        let place = metres * table.number((row, 1), table.header.cells[1], [-FAR, FAR])?;
        if places.insert(node, place).is_some() {
            let found = format!("{node} a second time");
            return Err(table.wrong((row, 0), "node", &found, "every node once"));
        }
    }
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_have_places_in_any_unit() {
        let places = read("1=0 in, 2 = 3 in,7=0.4, 9=33,5 in").unwrap();
        let found: Vec<(i64, f64)> = places.into_iter().collect();
        for ((node, x), wanted) in found.iter().zip([(1, 0.0), (2, 0.0762), (7, 0.4), (9, 0.8509)])
        {
            assert!(*node == wanted.0 && (x - wanted.1).abs() < 1e-12, "{found:?}");
        }
        assert_eq!(found.len(), 4);
    }

    #[test]
    fn what_is_no_place_is_refused() {
        for (text, told) in [
            ("1", "node,x_in"),
            ("a=3 in", "found a=3 in"),
            ("1=3 kg", "node 1"),
            ("1=3 in, 1=4 in", "node 1 a second time"),
            ("missing.csv", "cannot read missing.csv"),
        ] {
            let said = read(text).unwrap_err().to_string();
            assert!(said.contains(told), "{text}: {said}");
        }
    }
}
