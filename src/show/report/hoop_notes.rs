//! What was assumed of a barrel and where its model ends, in sentences.

use crate::base::number::significant;
use crate::bat::body::Bat;
use crate::modes::hoop::Note;
use crate::show::report::units::Units;
use crate::study::trampoline::barrel::Barrel;

/// A sentence each, without a capital and a full stop at its ends.
pub fn notes(bat: &Bat, barrel: &Barrel, units: Units) -> Vec<String> {
    let mut all: Vec<String> = barrel.hoop().notes().iter().map(|note| said(note, units)).collect();
    if let Some([less, more]) = barrel.by_poisson {
        let [less, more] = [less, more].map(|change| significant(100.0 * change, 2));
        all.push(format!(
            "a Poisson's ratio that is 0.05 smaller or larger changes the first hoop mode by {less} or \
             {more} % (\"poisson_ratio\" in the bat file)"
        ));
    }
    all.extend(alive(barrel));
    all.extend(dented(barrel));
    if barrel.wall.is_none() {
        all.push(format!(
            "the ball at {} from the knob end does not meet the stretch that is modelled",
            units.inline(units.length(barrel.test.at))
        ));
    }
    all.extend(open_tip(bat, barrel));
    all
}

/// A first mode that reaches the beginning of the stretch.
fn alive(barrel: &Barrel) -> Option<String> {
    let change = barrel.clamped_change.filter(|change| change.abs() > barrel.test.hoop.tol)?;
    Some(format!(
        "the first hoop mode is not dead where the model begins: clamped there it is {} % higher, and the \
         true one lies between",
        significant(100.0 * change, 2)
    ))
}

/// A dent that is too deep for small motions.
fn dented(barrel: &Barrel) -> Option<String> {
    let (wall, rebound) = (barrel.wall.as_ref()?, barrel.rebound.as_ref()?);
    let share = rebound.figures.dent / wall.thickness;
    rebound.figures.is_deep().then(|| {
        format!(
            "the wall is dented by {} of its thickness: beyond half of it the dent is not small, as is \
             assumed here, and a metal may yield",
            significant(share, 2)
        )
    })
}

/// A barrel that is open at its tip.
fn open_tip(bat: &Bat, barrel: &Barrel) -> Option<String> {
    let pieces = &bat.profile().pieces;
    let last = pieces.last()?;
    let open = last.at(1.0).inner > 0.0 && bat.layup(last).core.is_none();
    open.then(|| {
        let _ = barrel;
        "the tip is open: a plug in it (a \"core\" in a region of the last 12 mm) raises the first hoop mode \
         by about 5 % and moves its largest motion from the tip to the barrel"
            .to_owned()
    })
}
