//! The names of the engine that the studies use.

pub use sweetspot::base::error::{Complaint, Error, FilePosition, Result, nearest};
pub use sweetspot::base::linear::{dot, inverse};
pub use sweetspot::base::mistakes::Mistakes;
pub use sweetspot::base::number::{shortest, significant};
pub use sweetspot::base::quadrature::gauss;
pub use sweetspot::base::telling::{Tell, nobody};
pub use sweetspot::base::units::{
    INCH, POUND_FORCE, Quantity, factor, inches, ounces, shown_length,
};
pub use sweetspot::base::{error, file, golden, linear, marks, mistakes, threads, typed, units};
pub use sweetspot::bat::body::{Bat, STANDARD_PIVOT};
pub use sweetspot::bat::edit::{Bore, Change, Cork, Cup, Edit};
pub use sweetspot::bat::fixtures::{Attachment, Fixtures, Region};
pub use sweetspot::bat::inertia::Inertia;
pub use sweetspot::bat::layup::{Layup, Worth};
pub use sweetspot::bat::material::{BUILT_IN, Material, Scatter};
pub use sweetspot::bat::profile::{
    Interpolation, Piece, Profile, Radii, SAME_PLACE, Section, Stations,
};
pub use sweetspot::bat::theory::Theory;
pub use sweetspot::bat::turned::DiameterChange;
pub use sweetspot::bat::weighed::Weighed;
pub use sweetspot::beam::mesh::Mesh;
pub use sweetspot::beam::rule::DEGREES;
pub use sweetspot::beam::wall::elastic::{ASSUMED_POISSON_RATIO, poisson_ratio};
pub use sweetspot::collision::answer::LATER;
pub use sweetspot::collision::ball::Ball;
pub use sweetspot::collision::bbcor::TEST_SPEED;
pub use sweetspot::collision::figures::{BarrelSpeed, SwingLaw};
pub use sweetspot::collision::hit::{Effort, Impact, Model, Scene, greater};
pub use sweetspot::collision::hitter::Hitter;
pub use sweetspot::collision::hoop_wall::{HoopInHit, HoopWall, WhyRigid, barrel_walls};
pub use sweetspot::collision::rigid::RigidBat;
pub use sweetspot::collision::setup::Setup;
pub use sweetspot::collision::strike::Glance;
pub use sweetspot::collision::sweep::{Accuracy, Sweep, Trial, sweep};
pub use sweetspot::collision::sweet_spot::{FEW, HitsAlong, Peak, SweetSpot};
pub use sweetspot::collision::wall_figures::{WallBbcor, WallFigures};
pub use sweetspot::files::document::Document;
pub use sweetspot::files::folder::{Folder, Outside};
pub use sweetspot::files::json_node::{Node, Object};
pub use sweetspot::files::schema::amount::Amount;
pub use sweetspot::files::sheet::{Sheet, SheetRow};
pub use sweetspot::files::{balls, part_file, scene_file};
pub use sweetspot::modes::batch::{Way, solutions};
pub use sweetspot::modes::damping::Damped;
pub use sweetspot::modes::hoop::{Hoop, HoopMode, HoopRequest, KnobSide, rings};
pub use sweetspot::modes::mode::Mode;
pub use sweetspot::modes::plan::Plan;
pub use sweetspot::modes::prepared::{Prepared, prepare};
pub use sweetspot::modes::shares::Shares;
pub use sweetspot::modes::shifts::typical_shear;
pub use sweetspot::modes::solution::Timing;
pub use sweetspot::modes::solve::{
    MOST_DENSE, Request, Solution, Solver, own_and_recomputed, solve,
};
pub use sweetspot::modes::task::Task;
pub use sweetspot::modes::tuned::tuned;
pub use sweetspot::motion::frf::{Frf, ResponseKind};
pub use sweetspot::motion::sound::ASSUMED_LOSS;
