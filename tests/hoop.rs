//! Hoop modes against exact three-dimensional elasticity, against published numbers and against laws that
//! hold for every wall.

#[path = "hoop_walls/mod.rs"]
mod hoop_walls;

use std::f64::consts::TAU;

use hoop_walls::exact::{Ring, roots_near};
use hoop_walls::{
    FREE, aluminium, barrel_in_parts, frequencies, northwestern, open_barrel, plugged_barrel,
    spectrum, tube,
};
use sweetspot::bat::edit::{Change, Edit, Sleeve};
use sweetspot::bat::material::{PoissonRatios, ShearModuli};
use sweetspot::beam::wall::columns::Grading;
use sweetspot::beam::wall::elastic::Elastic;
use sweetspot::beam::wall::unknowns::EndHold;
use sweetspot::modes::compliance::taken;
use sweetspot::modes::hoop::spectrum::count_below;
use sweetspot::modes::hoop::surface::Surface;
use sweetspot::modes::hoop::{Hoop, HoopRequest, KnobSide, Note, Patch, rings};
use sweetspot::{Bat, Material};
use sweetspot_proof::bundled::bundled_bat;

/// No geometric steps.
const EVEN: Grading = Grading { knob: 0, tip: 0, kink: 0, least_kink: 0.0, corner: 0, soft: 0 };
/// The number of steps towards free ends.
const fn ends(steps: usize) -> Grading {
    Grading { knob: steps, tip: steps, ..EVEN }
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    for (found, expected) in found.iter().zip(expected) {
        let off = found / expected - 1.0;
        assert!(off.abs() < tolerance, "{found:.12} {expected:.12}: {off:.1e}");
    }
}

/// Frequencies (Hz) of `validation/hoop` and their accuracy.
fn published(case: &str, harmonic: usize) -> (Vec<f64>, f64) {
    let file: serde_json::Value =
        serde_json::from_str(include_str!("../validation/hoop/hoop.json")).unwrap();
    let all = file["modes"].as_array().unwrap();
    let own = all.iter().find(|row| row["case"] == case && row["harmonic"] == harmonic).unwrap();
    let hertz = own["hz"].as_array().unwrap().iter().map(|hz| hz.as_f64().unwrap()).collect();
    (hertz, own["within"].as_f64().unwrap())
}

/// Compares the results with `validation/hoop`.
fn as_published(found: &[f64], case: &str, harmonic: usize) {
    let (expected, within) = published(case, harmonic);
    assert_eq!(found.len(), expected.len());
    close(found, &expected, within);
}

/// Equation of motion through the wall, integrated from the bore to the surface, both without load.
#[test]
fn a_tube_between_diaphragms_rings_as_exact_elasticity_says() {
    let [length, radius, thickness] = [0.25, 0.030, 0.002];
    let bat = tube(length, radius, thickness, aluminium());
    for n in [2, 3, 4] {
        let found = frequencies(&bat, 0.0, [10, 6], EVEN, n, [EndHold::Diaphragm; 2], 2);
        as_published(&found, "tube_bat between diaphragms, m = 1, 2", n);
        for (m, found) in found.iter().enumerate() {
            let ring = Ring {
                layers: vec![(Elastic::isotropic(&aluminium(), 0.33), thickness)],
                inner: radius - 0.5 * thickness,
                n,
                wave: (m + 1) as f64 * std::f64::consts::PI / length,
            };
            close(&[*found], &[roots_near(&ring, *found)], 1e-11);
        }
    }
}

/// The plane motion of a ring, and Love's formula without stretching, which lies 0.23 % above it.
#[test]
fn the_ring_of_the_exact_solution_is_the_published_one() {
    for n in [2, 3, 4] {
        let (published, within) = published("tube_bat, ring in plane strain", n);
        let published = published[0];
        let layers = vec![(Elastic::isotropic(&aluminium(), 0.33), 0.002)];
        let ring = Ring { layers, inner: 0.029, n, wave: 0.0 };
        close(&[roots_near(&ring, published)], &[published], within);
        let love = {
            let n = n as f64;
            let square = 71e9 * 0.002_f64.powi(2) * (n * (n * n - 1.0)).powi(2)
                / (12.0 * 2810.0 * 0.03_f64.powi(4) * (1.0 - 0.33_f64.powi(2)) * (n * n + 1.0));
            square.sqrt() / TAU
        };
        assert!(love > published && love < published * (1.0 + 4e-4 * (n * n * n) as f64));
    }
}

#[test]
fn free_tubes_ring_as_published() {
    let bat = tube(0.25, 0.030, 0.002, aluminium());
    let of = |n| frequencies(&bat, 0.0, [10, 6], ends(4), n, FREE, 3);
    for n in [1, 2, 3] {
        as_published(&of(n), "tube_bat, free", n);
    }
    let thin = tube(0.25, 0.030, 0.0003, aluminium());
    let of = |n| frequencies(&thin, 0.0, [12, 5], ends(4), n, FREE, 3);
    for n in [2, 3] {
        as_published(&of(n), "tube_thin, free", n);
    }
}

/// Inextensional theory in closed form, eight exponentials: accurate to the first order in h/R.
#[test]
fn a_thin_free_tube_is_near_the_exact_shell_of_sanders_and_koiter() {
    let thin = tube(0.25, 0.030, 0.0003, aluminium());
    let found = frequencies(&thin, 0.0, [8, 3], ends(1), 2, FREE, 2);
    close(&found, &[218.594_147_70, 223.506_884_62], 1e-4);
    assert!(found[0] < 218.594_147_70 && found[1] < 223.506_884_62);
}

#[test]
fn an_open_barrel_rings_as_published() {
    let bat = open_barrel(0.0030);
    let of = |n| frequencies(&bat, 0.2, [12, 6], Grading { tip: 4, ..EVEN }, n, FREE, 3);
    for n in [2, 3] {
        as_published(&of(n), "bbcor_open", n);
    }
}

/// A corner inside, where wall, plug and air meet, and an edge of two materials at the tip.
#[test]
fn a_plugged_barrel_rings_as_published() {
    let bat = plugged_barrel(0.0030);
    let grading = Grading { tip: 3, corner: 4, soft: 4, ..EVEN };
    let of = |n| frequencies(&bat, 0.28, [9, 6], grading, n, FREE, 3);
    for n in [2, 3] {
        as_published(&of(n), "bbcor_plug", n);
    }
}

/// Kinks of the profile. The published numbers are for the density of the file, not for the weighed mass. They bound
/// from above and are themselves 1 to 4e-9 too high: with degrees 12 and 7, and 14 and 9, frequencies fall that far
/// below them.
#[test]
fn a_barrel_with_kinks_rings_as_published() {
    let bat = northwestern();
    let scale = (bat.material().density / 4793.91).sqrt();
    let grading = Grading { tip: 3, kink: 5, ..EVEN };
    let of = |n| {
        let found = frequencies(&bat, 0.01905, [12, 7], grading, n, FREE, 3);
        found.into_iter().map(|f| f * scale).collect::<Vec<_>>()
    };
    for n in [2, 3] {
        as_published(&of(n), "northwestern", n);
    }
}

/// A cylinder of steel, 10 m long, 2 m in radius, 0.4 m thick: test FV41 of NAFEMS, as other programs have
/// it, with axisymmetric modes. Clamped, in inches and pounds, the cylinder that Kraus computed.
#[test]
fn published_cylinders_come_out() {
    let mut steel = Material::new(8000.0, 200e9).unwrap();
    steel.poisson_ratio = Some(0.3);
    let found = frequencies(&tube(10.0, 2.0, 0.4, steel.clone()), 0.0, [8, 4], ends(1), 0, FREE, 5);
    close(&found, &[243.53, 377.41, 394.11, 397.72, 405.28], 4e-4);
    let inch = 0.0254_f64;
    let mut thin =
        Material::new(0.282_072 * 0.453_592_37 / inch.powi(3), 30e6 * 6_894.757_293_17).unwrap();
    thin.poisson_ratio = Some(0.3);
    let cylinder = tube(12.0 * inch, 3.0 * inch, 0.01 * inch, thin);
    for (n, published) in [(6, 536.0), (8, 720.0), (4, 768.0)] {
        let found = frequencies(&cylinder, 0.0, [10, 3], ends(1), n, [EndHold::Clamped; 2], 1);
        close(&found, &[published], 1e-3);
    }
}

/// A tube of two bonded layers, one of them a composite: exact elasticity through both.
#[test]
fn layers_of_metal_and_composite_ring_as_exact_elasticity_says() {
    let [length, inner, wall, sleeve] = [0.25, 0.028, 0.002, 0.0015];
    let composite = composite();
    let bat = tube(length, inner + 0.5 * wall, wall, aluminium());
    let around = Sleeve { from: 0.0, to: length, thickness: sleeve, material: composite.clone() };
    let bat = bat.edited(&[Edit { name: None, change: Change::Sleeve(around) }]).unwrap();
    let elastic = Elastic::orthotropic(&composite).unwrap().unwrap();
    for n in 2..=4 {
        let found = frequencies(&bat, 0.0, [9, 6], EVEN, n, [EndHold::Diaphragm; 2], 2);
        for (m, found) in found.iter().enumerate() {
            let ring = Ring {
                layers: vec![(Elastic::isotropic(&aluminium(), 0.33), wall), (elastic, sleeve)],
                inner,
                n,
                wave: (m + 1) as f64 * std::f64::consts::PI / length,
            };
            close(&[*found], &[roots_near(&ring, *found)], 1e-9);
        }
    }
}

/// Carbon and glass in epoxy, of no maker.
fn composite() -> Material {
    let mut material = Material::new(1600.0, 60e9).unwrap();
    material.hoop_modulus = Some(35e9);
    material.radial_modulus = Some(9e9);
    material.shear_moduli =
        Some(ShearModuli { along_around: 12e9, along_across: 4e9, around_across: 3.5e9 });
    material.poisson_ratios =
        Some(PoissonRatios { along_around: 0.25, along_across: 0.3, around_across: 0.35 });
    material
}

#[test]
fn a_composite_with_the_constants_of_a_metal_is_that_metal() {
    let metal = aluminium();
    let (e, nu) = (metal.youngs_modulus, 0.33);
    let shear = 0.5 * e / (1.0 + nu);
    let mut same = metal.clone();
    (same.hoop_modulus, same.radial_modulus) = (Some(e), Some(e));
    same.shear_moduli =
        Some(ShearModuli { along_around: shear, along_across: shear, around_across: shear });
    same.poisson_ratios =
        Some(PoissonRatios { along_around: nu, along_across: nu, around_across: nu });
    let [a, b] = [metal, same].map(|material| {
        let bat = tube(0.25, 0.030, 0.002, material);
        frequencies(&bat, 0.0, [6, 3], ends(1), 2, FREE, 4)
    });
    close(&a, &b, 1e-11);
    let mut impossible = composite();
    impossible.poisson_ratios =
        Some(PoissonRatios { along_around: 3.0, along_across: 0.3, around_across: 0.3 });
    assert!(Elastic::orthotropic(&impossible).unwrap_err().to_string().contains("poisson_ratios"));
}

#[test]
fn doubling_lengths_halves_frequencies_and_they_go_as_the_root_of_stiffness_over_density() {
    let of = |bat: &Bat| frequencies(bat, 0.0, [6, 3], ends(1), 2, FREE, 4);
    let usual = of(&tube(0.25, 0.030, 0.002, aluminium()));
    let doubled = of(&tube(0.50, 0.060, 0.004, aluminium()));
    let halves: Vec<f64> = usual.iter().map(|f| 0.5 * f).collect();
    close(&doubled, &halves, 1e-11);
    let mut other = aluminium();
    other.youngs_modulus *= 3.0;
    other.density *= 0.5;
    let stiffer: Vec<f64> = usual.iter().map(|f| f * 6.0_f64.sqrt()).collect();
    close(&of(&tube(0.25, 0.030, 0.002, other)), &stiffer, 1e-11);
}

/// Conforming elements: every space that holds another gives lower frequencies.
#[test]
fn frequencies_fall_with_every_degree() {
    let bat = open_barrel(0.0030);
    let of = |degrees| frequencies(&bat, 0.28, degrees, EVEN, 2, FREE, 4);
    for [coarse, fine] in [[[4, 2], [5, 2]], [[5, 2], [5, 3]], [[5, 3], [7, 3]], [[7, 3], [7, 4]]] {
        let (coarse, fine) = (of(coarse), of(fine));
        assert!(coarse.iter().zip(&fine).all(|(a, b)| b <= a), "{coarse:?} {fine:?}");
    }
}

#[test]
fn a_free_knob_side_bounds_from_below_and_a_clamped_one_from_above() {
    let bat = open_barrel(0.0030);
    let grading = Grading { tip: 1, ..EVEN };
    let of = |from, hold| frequencies(&bat, from, [8, 4], grading, 2, [hold, EndHold::Free], 4);
    let whole = of(0.0, EndHold::Free);
    for from in [0.30, 0.35] {
        let (low, high) = (of(from, EndHold::Free), of(from, EndHold::Clamped));
        for k in 0..4 {
            assert!(low[k] <= whole[k] && whole[k] <= high[k], "{from} {k}");
        }
    }
}

#[test]
fn a_sleeve_of_the_wall_s_own_material_is_a_thicker_wall() {
    let thin = tube(0.25, 0.0295, 0.001, aluminium());
    let around = Sleeve { from: 0.0, to: 0.25, thickness: 0.001, material: aluminium() };
    let sleeved = thin.edited(&[Edit { name: None, change: Change::Sleeve(around) }]).unwrap();
    let thick = tube(0.25, 0.030, 0.002, aluminium());
    let of = |bat: &Bat| frequencies(bat, 0.0, [8, 5], ends(3), 2, FREE, 4);
    close(&of(&sleeved), &of(&thick), 2e-8);
}

/// A step of the wall, whose neighbours have no common border: between the thin and the thick tube, and the same from
/// the other end.
#[test]
fn a_stepped_tube_rings_the_same_from_either_end() {
    use sweetspot::bat::profile::{Interpolation, Stations};
    let stations = Stations {
        x: vec![0.0, 0.12, 0.12, 0.25],
        outer: vec![0.031, 0.031, 0.0315, 0.0315],
        inner: vec![0.029, 0.029, 0.0287, 0.0287],
        interpolation: Interpolation::Linear,
    };
    let profile = sweetspot::Profile::new(stations).unwrap();
    let bats = [profile.clone(), profile.reversed()]
        .map(|profile| Bat::builder(profile, aluminium()).build().unwrap());
    let grading = Grading { corner: 4, ..ends(2) };
    let [a, b] = bats.each_ref().map(|bat| frequencies(bat, 0.0, [7, 4], grading, 2, FREE, 4));
    // The rounding error with elements of 30 µm.
    close(&a, &b, 1e-8);
    let [thin, thick] = [(0.030, 0.002), (0.0301, 0.0028)].map(|(radius, thickness)| {
        frequencies(&tube(0.25, radius, thickness, aluminium()), 0.0, [6, 3], ends(1), 2, FREE, 1)
    });
    assert!(thin[0] < a[0] && a[0] < thick[0], "{thin:?} {a:?} {thick:?}");
}

/// Harmonic 1 of the wall is the beam: two rigid motions, and Timoshenko's frequencies on a slender tube to the order
/// of his theory.
#[test]
fn the_first_harmonic_is_the_beam() {
    let slender = tube(0.9, 0.012, 0.002, aluminium());
    let wall = frequencies(&slender, 0.0, [8, 4], ends(1), 1, FREE, 3);
    close(&wall, &[187.266, 511.380, 988.929], 2e-6);
    let theory = sweetspot::Theory::Timoshenko;
    let request =
        sweetspot::Request { modes: 3, tolerance: 1e-7, theory, ..sweetspot::Request::plain() };
    let mut metal = aluminium();
    metal.shear_modulus = Some(71e9 / 2.66);
    let solution = sweetspot::solve(&tube(0.9, 0.012, 0.002, metal), &request).unwrap();
    let beam: Vec<f64> = solution.modes.iter().map(|mode| mode.frequency()).collect();
    close(&wall, &beam, 2e-3);
    // Only two rigid motions are below any frequency.
    let system = spectrum(&slender, 0.0, [6, 3], ends(1), 1, FREE, 1).system;
    let wall = sweetspot::modes::hoop::system::Wall {
        mesh: system.mesh.clone(),
        materials: system.materials.clone(),
    };
    assert_eq!(count_below(&wall, 1, FREE, TAU * 180.0), 0);
    assert_eq!(count_below(&wall, 1, FREE, TAU * 190.0), 1);
}

/// The signs of the pivots show that no mode is missing.
#[test]
fn as_many_modes_are_found_as_are_below_a_frequency() {
    let bat = open_barrel(0.0030);
    for n in [0, 2, 3] {
        let found = spectrum(&bat, 0.28, [6, 3], Grading { tip: 1, ..EVEN }, n, FREE, 8);
        let wall = sweetspot::modes::hoop::system::Wall {
            mesh: found.system.mesh.clone(),
            materials: found.system.materials.clone(),
        };
        for (k, omega) in found.omegas.iter().enumerate() {
            for (share, below) in [(1.0 - 1e-6, k), (1.0 + 1e-6, k + 1)] {
                assert_eq!(count_below(&wall, n, FREE, share * omega), below, "{n} {k}");
            }
        }
    }
}

/// With columns that begin where the pressure begins.
#[test]
fn the_wall_gives_way_under_a_ball_as_published() {
    let patch = Patch::under(0.6858, 0.0366, 0.0333, 0.008);
    let ends = [patch.x - patch.half_length, patch.x + patch.half_length];
    let bat = barrel_in_parts(0.0030, &[0.58, ends[0], ends[1], 0.8382]);
    let spectra = [0, 2, 3, 4, 5, 6].map(|n| {
        let grading = Grading { tip: 4, ..EVEN };
        spectrum(&bat, 0.2, [12, 7], grading, n, FREE, 3)
    });
    let surface = Surface::of(&spectra[0].system.mesh);
    let under = spectra.each_ref().map(|spectrum| surface.under(spectrum, &patch));
    let found: Vec<f64> = under.iter().map(|share| share.flexibility).collect();
    let published = [
        7.701_487_1e-10,
        4.111_918_24e-8,
        1.069_956_54e-8,
        3.594_368_8e-9,
        1.320_915_5e-9,
        5.104_258_1e-10,
    ];
    close(&found, &published, 5e-7);
    close(&under[1].gains, &[2.217_415_5, 2.263_246_1, 2.378_587_1], 5e-6);
    for (spectrum, share) in spectra.iter().zip(&under) {
        let [soft, slow] = taken(&share.gains, |k| spectrum.omegas[k].powi(2));
        assert!(soft < share.flexibility, "{} {soft}", share.harmonic);
        assert!(slow < share.slowness * (1.0 + 1e-9));
    }
}

/// The default answer, and the same ten times finer in the tolerance.
#[test]
fn a_barrel_is_answered_to_its_tolerance() {
    let bat = open_barrel(0.0030);
    let hoop = Hoop::of(&bat, &HoopRequest::default()).unwrap();
    assert!(hoop.met() && hoop.notes() == [Note::OpenTip]);
    let lowest = hoop.lowest(4);
    let expected = [1_939.920_069_39, 2_132.837_659_05, 2_810.245_663_24];
    for (mode, expected) in lowest.iter().zip(expected) {
        let off = mode.frequency_hz / expected - 1.0;
        assert!(mode.harmonic == 2 && mode.error <= 1e-4 && off.abs() <= 3.0 * mode.error);
    }
    // An open end moves most at the tip itself.
    assert!((lowest[0].largest_at_m - 0.8382).abs() < 1e-9);
    let outline = hoop.outline(hoop.modes().iter().position(|m| m == lowest[0]).unwrap(), 41);
    assert!((outline.radial[40] - 1.0).abs() < 1e-12 && outline.radial[0].abs() < 1e-3);
    // Without stretching, U + nV = 0 in the middle of the wall; at h/2 farther out V has rotated by h/2R (V + nU).
    let turned = 0.0015 / 0.0318 * 1.5;
    assert!((outline.around[40] + 0.5 - turned).abs() < 0.02, "{}", outline.around[40]);
    let clamped = HoopRequest { end: KnobSide::Clamped, ..HoopRequest::default() };
    let clamped = Hoop::of(&bat, &clamped).unwrap();
    let off = clamped.lowest(1)[0].omega / lowest[0].omega - 1.0;
    assert!(off.abs() < 1e-6, "{off:e}");
}

/// On the published barrels and on some random ones; `sweetspot validate --promise` has twenty.
#[test]
fn no_true_error_is_more_than_three_times_the_stated_one() {
    for row in sweetspot_proof::hoop_promise::rows(&|_, _| {}, 4).unwrap() {
        assert!(row.holds() && row.met, "{row:?}");
    }
}

#[test]
fn what_has_no_wall_to_ring_is_refused_with_the_reason() {
    let request = HoopRequest::default();
    let solid = bundled_bat("meshes/r161.json").unwrap();
    assert!(!rings(&solid));
    assert!(Hoop::of(&solid, &request).unwrap_err().to_string().contains("solid"));
    let mut wood = Material::named("white-ash").unwrap();
    wood.poisson_ratio = Some(0.3);
    let hollow = tube(0.8, 0.03, 0.01, wood);
    assert!(!rings(&hollow));
    assert!(Hoop::of(&hollow, &request).unwrap_err().to_string().contains("grain"));
    // The knob of this bat is a tube that does not touch its handle.
    let bat = northwestern();
    assert!(rings(&bat) && Hoop::of(&bat, &request).unwrap().from() > 0.019);
    let error = Hoop::between(&bat, [0.0, bat.length()], &request).unwrap_err();
    assert!(error.to_string().contains("meet"), "{error}");
    let tol = HoopRequest { tol: f64::NAN, ..HoopRequest::default() };
    assert!(Hoop::of(&bat, &tol).is_err());
}
