//! A picture of a page: in both systems of units, as wide as a page and as narrow as a telephone.

use crate::parts::escape::html as escaped;
use crate::plot::{Paper, Picture, Sheet};
use sweetspot::Result;

/// One picture in all its forms.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// The name of the picture, by which parts of a page refer to it.
    pub name: String,
    /// The picture, wide and narrow, each in SI and in US units.
    pub forms: [[Picture; 2]; 2],
}

impl Figure {
    /// Every picture that `draw` draws on a sheet, on all sheets of a page.
    ///
    /// # Errors
    ///
    /// Those of `draw`.
    pub fn all(draw: impl Fn(Sheet) -> Result<Vec<Picture>>) -> Result<Vec<Self>> {
        let on = |us, paper| draw(Sheet { us, paper });
        let wide = on(false, Paper::Page)?.into_iter().zip(on(true, Paper::Page)?);
        let narrow = on(false, Paper::Narrow)?.into_iter().zip(on(true, Paper::Narrow)?);
        let both = wide.zip(narrow).map(|((a, b), (c, d))| [[a, b], [c, d]]);
        Ok(both.map(|forms| Self { name: forms[0][0].name.clone(), forms }).collect())
    }

    /// The figure with its title and facts, and further content within it and below it.
    pub fn html(&self, [within, below]: [&str; 2]) -> String {
        let [wide, narrow] = &self.forms;
        let title = escaped(&wide[0].title);
        let facts = switched("span", [&wide[0].facts, &wide[1].facts].map(|facts| escaped(facts)));
        let forms = [("wide", wide), ("narrow", narrow)].map(|(room, [si, us])| {
            let svg = switched("div", [si.svg.clone(), us.svg.clone()]);
            format!("<div class=\"{room}\">\n{svg}</div>\n")
        });
        format!(
            "<figure id=\"plot-{}\">\n<figcaption><strong>{title}</strong> {facts}</figcaption>\n\
             <div class=\"sheet\">\n{}{within}</div>\n{below}</figure>\n",
            self.name,
            forms.concat()
        )
    }
}

/// A text in both systems of units, once where it is the same.
fn switched(tag: &str, [si, us]: [String; 2]) -> String {
    match si == us {
        true => format!("<{tag}>{si}</{tag}>"),
        false => format!("<{tag} class=\"si\">{si}</{tag}><{tag} class=\"us\">{us}</{tag}>"),
    }
}
