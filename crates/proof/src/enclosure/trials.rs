//! Which motions are the trials? They are the modes of the solver, as strains on the stretches of its mesh.

use std::ops::Range;

use crate::enclosure::moved::Trial;
use sweetspot::base::Result;
use sweetspot::bat::{Bat, Theory};
use sweetspot::beam::View;
use sweetspot::beam::attached::Contact;
use sweetspot::modes::pairs::pairs_of;
use sweetspot::modes::plan::Plan;
use sweetspot::modes::request::CONVERGED;

/// The `count` slowest modes on the mesh of that plan, whose elements do not reach over stations.
///
/// # Errors
///
/// Those of the eigensolver.
pub fn trials(bat: &Bat, plan: &Plan, count: usize, theory: Theory) -> Result<Vec<Trial>> {
    let mut pairs = pairs_of(bat, plan.degree, theory);
    pairs.assemble(bat, &plan.mesh);
    let count = count.min(pairs.view().freedom());
    pairs.solve(count, CONVERGED)?;
    let vectors = std::mem::take(&mut pairs.lanczos().vectors);
    let view = pairs.view();
    let size = view.dimension();
    Ok(vectors.chunks_exact(size).map(|q| trial(&view, q)).collect())
}

/// Strains from scaled strains, from knob to tip: outwards is backwards on the knob side, where odd polynomials
/// change sign, and a shear strain does.
fn trial(view: &View<f64>, q: &[f64]) -> Trial {
    let (terms, count, split) = (view.terms - 2, view.count, view.split);
    let blocks = view.strains / terms;
    let mut all = [vec![0.0; terms * count], vec![0.0; if blocks > 1 { terms * count } else { 0 }]];
    let mut strains = vec![0.0; view.strains];
    for number in 0..count {
        let located = view.at(number);
        located.cell.strains(&q[located.strains.clone()], terms, &mut strains);
        let inside = number < split;
        let element = if inside { split - 1 - number } else { number };
        for (block, (all, own)) in all.iter_mut().zip(strains.chunks_exact(terms)).enumerate() {
            let all = &mut all[element * terms..(element + 1) * terms];
            for (j, (to, from)) in all.iter_mut().zip(own).enumerate() {
                let turned = inside && (j + block) % 2 == 1;
                *to = if turned { -from } else { *from };
            }
        }
    }
    let [bending, shear] = all;
    let contacts = view.placed().map_or(&[][..], |placed| &placed.contacts);
    let of = |contact: &Contact<f64>| {
        let spring = contact.spring.as_ref();
        spring.map_or(0.0, |spring| q[spring.place] * spring.softness)
    };
    let held = contacts.iter().filter(|contact| !contact.in_a_bed()).map(of);
    // Legendre coefficients of the deflection on the first and last element of the bed, counted outwards.
    let element = |number: usize| if number < split { split - 1 - number } else { number };
    let on_bed = (0..count).filter_map(|number| Some((element(number), number, view.bed(number)?)));
    let end = |number: usize, bed: Range<usize>, tipwards: bool| -> f64 {
        let sign = if (number < split) == tipwards { -1.0_f64 } else { 1.0 };
        contacts[bed].iter().zip(0..).map(|(contact, j)| sign.powi(j) * of(contact)).sum()
    };
    let first = on_bed.clone().min_by_key(|(element, ..)| *element);
    let last = on_bed.max_by_key(|(element, ..)| *element);
    let end = |on: Option<(usize, usize, Range<usize>)>, tipwards: bool| {
        on.map_or(0.0, |(_, number, bed)| end(number, bed, tipwards))
    };
    let bed = [end(first, false), end(last, true)];
    let joints = view.placed().map_or(&[][..], |placed| &placed.joints);
    let points = view.placed().map_or(&[][..], |placed| &placed.points);
    let springs = joints.iter().copied().chain(points.iter().filter_map(|point| point.spring));
    let gives = springs.map(|spring| q[spring.place] * spring.softness);
    Trial { terms, bending, shear, held: held.collect(), bed, gives: gives.collect() }
}
