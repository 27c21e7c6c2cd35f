//! The pictures that belong to a result.

use crate::analysis::Analysis;
use crate::plot::subject::Subject;
use crate::plot::{
    Picture, Sheet, contact, exit_speed, hands, hoop, lathe, ledger, profile, shapes, spot, u_curve,
};
use sweetspot::collision::aftermath::Aftermath;
use sweetspot::collision::{Hitter, Model, Scene, Sweep, SweetSpot};
use sweetspot::{Bat, Result, Solution};
use sweetspot_study::lathe::map::LatheMap;
use sweetspot_study::trade::u_curve::Curve;

/// The bat and its modes: `profile`, `shapes`. With a swing, its pivot beyond the knob end (m) is marked.
pub fn of_modes(
    sheet: Sheet,
    bat: &Bat,
    solution: &Solution,
    swing_pivot: Option<f64>,
) -> Vec<Picture> {
    let name = bat.name();
    let side = profile::picture(sheet, &[Subject { name, bat, drawn: swing_pivot }]);
    let bent = shapes::picture(sheet, &[Subject { name, bat, drawn: solution }], shapes::MODES);
    std::iter::once(side).chain(bent).collect()
}

/// Hits along a bat, and how they came about.
#[derive(Debug, Clone, Copy)]
pub struct Hits<'a> {
    /// The bat that is hit.
    pub bat: &'a Bat,
    /// How ball and bat meet.
    pub model: Model,
    /// The swing, the pitch and the ball.
    pub scene: &'a Scene,
    /// The hits along it.
    pub sweep: &'a Sweep,
    /// Its sweet spot by every definition.
    pub spot: &'a SweetSpot,
}

impl Hits<'_> {
    /// `exit_speed` and `ledger` along the bat; `contact`, `hysteresis` and `hands` of the hit at one place (m), by
    /// default the sweet spot. Pictures that the model cannot give are left out.
    ///
    /// # Errors
    ///
    /// As [`Hitter::new`].
    pub fn pictures(&self, sheet: Sheet, at: Option<f64>) -> Result<Vec<Picture>> {
        let Self { bat, sweep, spot, .. } = *self;
        let (name, impacts) = (bat.name(), &sweep.impacts);
        let along = Subject { name, bat, drawn: (&impacts[..], spot) };
        let mut all: Vec<Picture> = exit_speed::picture(sheet, &[along]).into_iter().collect();
        all.extend(ledger::picture(sheet, name, bat, impacts, 0.0));
        if let Some(x) = at.or(spot.exit_speed_max.map(|peak| peak.x)) {
            all.extend(of_touches(sheet, &[(name, *self, x)])?);
        }
        Ok(all)
    }
}

/// The contact in a hit on each of these bats, with its name in the picture and its place (m), and the motion at the
/// hands: `contact`, `hysteresis` and `hands`, where the model gives them.
///
/// # Errors
///
/// As [`Hitter::new`].
pub fn of_touches(sheet: Sheet, hits: &[(&str, Hits, f64)]) -> Result<Vec<Picture>> {
    let (mut touched, mut felt) = (vec![], vec![]);
    for (name, Hits { bat, model, scene, sweep, .. }, x) in hits {
        let hitter = Hitter::new(*model, scene, bat, &sweep.solution, sweep.effort)?;
        touched.extend(contact::ContactCurves::new(name, &hitter, *x));
        felt.extend(hitter.force(*x).map(|force| {
            let after = Aftermath::new(bat, &sweep.solution, *x, force);
            hands::HandCurves { name, after, x: scene.hands }
        }));
    }
    let mut all = contact::pictures(sheet, &touched);
    all.extend(hands::picture(sheet, &felt));
    Ok(all)
}

/// All pictures of an analysis: the bat with its sweet spot (`sweet_spot`), its modes, its hits, the barrel of a hollow
/// bat (`hoop`), and the effects of cuts (`lathe`) if they are known.
///
/// # Errors
///
/// As [`Hits::pictures`].
pub fn of_analysis(
    sheet: Sheet,
    analysis: &Analysis,
    map: Option<&LatheMap>,
) -> Result<Vec<Picture>> {
    let Analysis { bat, solution, task, hits, figures, .. } = analysis;
    let subject = Subject { name: bat.name(), bat, drawn: &figures.spot };
    let mut pictures: Vec<Picture> = spot::picture(sheet, &[subject]).into_iter().collect();
    pictures.extend(of_modes(sheet, bat, solution, Some(task.scene.pivot)));
    let (model, scene, spot) = (task.model, &task.scene, &figures.spot);
    pictures.extend(Hits { bat, model, scene, sweep: hits, spot }.pictures(sheet, None)?);
    let barrel = analysis.barrel.as_ref();
    pictures.extend(barrel.and_then(|barrel| hoop::picture(sheet, bat, barrel, hoop::MODES)));
    pictures.extend(map.and_then(|map| lathe::picture(sheet, map)));
    Ok(pictures)
}

/// The error of the first and of the last mode of a U-curve.
pub fn of_u_curve(name: &str, curves: &[Curve], modes: usize) -> Vec<Picture> {
    let last = modes.saturating_sub(1);
    let which = [0, last].into_iter().take(1 + usize::from(last > 0));
    which.filter_map(|mode| u_curve::picture(name, curves, mode)).collect()
}
