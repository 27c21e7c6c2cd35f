pub mod error;
pub mod units;
pub mod quadrature;
pub mod material;
mod pchip;
pub mod profile;
pub mod bat;
mod document;
mod station_table;
mod bat_file;
pub mod shape_file;
pub mod beam {
    pub mod mesh;
    pub mod element;
    pub mod statics;
    pub mod assembly;
}
pub mod eigen {
    pub mod tridiagonal;
    pub mod lanczos;
    pub mod dense;
}
pub mod modes;
pub mod plan;
pub mod dowel;
pub mod response;
pub mod theory;
pub mod collision {
    pub mod ball;
    pub mod rigid;
    pub mod energy_loss;
    pub mod hit;
    pub mod sweet_spot;
}
pub mod report;
pub mod validation;
