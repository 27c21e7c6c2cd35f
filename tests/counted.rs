//! The number of motions below a frequency, for bats whose frequencies have closed forms.

use crate::common;

use common::{DENSITY, LENGTH, MODULUS, RADIUS, dowel};
use sweetspot::Bat;
use sweetspot::bat::fixtures::{Attachment, Fixtures, Grip, Held, Joint, Support};
use sweetspot::bat::theory::Theory;
use sweetspot::beam::count::slower;
use sweetspot::beam::dowel::Ends::{self, *};
use sweetspot::beam::dowel::beta_l;
use sweetspot::beam::mesh::Mesh;
use sweetspot::beam::statics::Statics;

/// Frequencies with 24 elements of degree 5 are within 1e-6 of those of the beam; this limit is far above.
const BESIDE: f64 = 1e-3;

fn with(fixtures: Fixtures) -> Bat {
    let bare = dowel();
    let material = bare.material().clone();
    Bat::builder(bare.profile().clone(), material).name("test").fixtures(fixtures).build().unwrap()
}

fn counted(bat: &Bat, omega: f64) -> Option<usize> {
    let mut statics = Statics::<f64, 6, 6>::empty(bat, Theory::EulerBernoulli);
    statics.assemble(&[bat], &[&Mesh::along(bat, 24)]);
    slower(&statics.view(), omega)
}

/// ρA (kg/m).
fn line() -> f64 {
    DENSITY * std::f64::consts::PI * RADIUS * RADIUS
}

/// `ω = (βL)² √(EI/ρA)/L²` (rad/s).
fn omega(ends: Ends, n: usize) -> f64 {
    let stiffness_over_mass = MODULUS * RADIUS * RADIUS / (4.0 * DENSITY);
    (beta_l(ends, n) / LENGTH).powi(2) * stiffness_over_mass.sqrt()
}

/// The count rises by one at each of the first ten of these, from the number of rigid motions.
fn assert_steps(bat: &Bat, rigid: usize, omega: impl Fn(usize) -> f64) {
    for n in 1..=10 {
        let at = |share: f64| counted(bat, share * omega(n));
        assert_eq!(at(1.0 - BESIDE), Some(rigid + n - 1), "below frequency {n}");
        assert_eq!(at(1.0 + BESIDE), Some(rigid + n), "above frequency {n}");
    }
}

fn held(list: &[(f64, Held)]) -> Bat {
    let supports = list.iter().map(|(x, kind)| Support { x: *x, kind: *kind }).collect();
    with(Fixtures { supports, ..Fixtures::default() })
}

#[test]
fn the_count_rises_by_one_at_every_frequency_of_the_dowel_however_it_is_held() {
    let (near, far) = (0.0, LENGTH);
    for (ends, supports, rigid) in [
        (FreeFree, vec![], 2),
        (FreePinned, vec![(near, Held::Pinned)], 1),
        (ClampedFree, vec![(far, Held::Clamped)], 0),
        (PinnedPinned, vec![(near, Held::Pinned), (far, Held::Pinned)], 0),
        (ClampedPinned, vec![(near, Held::Clamped), (far, Held::Pinned)], 0),
        (ClampedClamped, vec![(near, Held::Clamped), (far, Held::Clamped)], 0),
    ] {
        assert_steps(&held(&supports), rigid, |n| omega(ends, n));
    }
}

/// A bed of stiffness k (N/m²) along the whole dowel adds k/ρA to every ω², the two rigid motions'
/// included.
#[test]
fn a_bed_along_the_whole_dowel_raises_every_frequency_alike() {
    let stiffness = 3e6;
    let grip = Grip { from: 0.0, to: LENGTH, stiffness, damping: 0.0 };
    let bedded = with(Fixtures { grip: Some(grip), ..Fixtures::default() });
    let rigid = (stiffness / line()).sqrt();
    assert_eq!(counted(&bedded, rigid * (1.0 - BESIDE)), Some(0));
    assert_steps(&bedded, 2, |n| omega(FreeFree, n).hypot(rigid));
}

/// An end of infinite mass does not move, one of infinite rotary inertia does not turn: the free
/// dowel with both at an end is clamped there, and keeps two rigid motions of no frequency.
#[test]
fn a_heavy_end_counts_as_a_clamp_and_two_rigid_motions() {
    let heavy = Attachment { x: 0.0, mass: 1e8, rotary_inertia: 1e8, ..Attachment::default() };
    let bat = with(Fixtures { attachments: vec![heavy], ..Fixtures::default() });
    assert_steps(&bat, 2, |n| omega(ClampedFree, n));
}

/// Extremely stiff springs are supports; an extremely soft joint in the middle of a pinned dowel leaves the halves of
/// the odd modes, each pinned at both ends.
#[test]
fn springs_and_joints_count_as_their_limits() {
    let spring = |x| Attachment { x, stiffness: 1e15, ..Attachment::default() };
    let sprung =
        with(Fixtures { attachments: vec![spring(0.0), spring(LENGTH)], ..Fixtures::default() });
    assert_steps(&sprung, 0, |n| omega(PinnedPinned, n));

    let pins = [0.0, LENGTH].map(|x| Support { x, kind: Held::Pinned });
    let hinge = Joint { x: 0.5 * LENGTH, rotational_stiffness: 1e-9 };
    let hinged =
        with(Fixtures { supports: pins.into(), joints: vec![hinge], ..Fixtures::default() });
    // By symmetry about the hinge: sideways the halves are pinned and free at it (after the hinge's
    // own slow motion), turning they are pinned at both ends.
    let mut all: Vec<f64> = (1..=6).map(|n| 4.0 * omega(PinnedPinned, n)).collect();
    all.extend((1..=6).map(|n| 4.0 * omega(FreePinned, n)));
    all.sort_by(f64::total_cmp);
    assert_steps(&hinged, 1, |n| all[n - 1]);
}
