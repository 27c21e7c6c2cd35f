//! The pages as one PDF, for printing in full size.

use std::fmt::Write;

use crate::template::sheet::{Drawn, Page};

/// Points of a PDF in a mm.
const PER_MM: f64 = 72.0 / 25.4;

/// The pages as a PDF file.
pub fn pdf(pages: &[Page]) -> Vec<u8> {
    // Objects: the catalogue, the pages, the font, then two for each page.
    let kids: Vec<String> = (0..pages.len()).map(|k| format!("{} 0 R", 4 + 2 * k)).collect();
    let mut objects = vec![
        "<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>".to_owned(),
        format!("<< /Type /Pages /Kids [{}] /Count {} >>", kids.join(" "), pages.len()),
        "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica /Encoding /WinAnsiEncoding >>"
            .to_owned(),
    ];
    for (k, page) in pages.iter().enumerate() {
        let [width, height] = [page.paper.width, page.paper.height].map(|mm| mm * PER_MM);
        objects.push(format!(
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {width:.3} {height:.3}] /Resources << /Font << /F1 3 \
             0 R >> >> /Contents {} 0 R >>",
            5 + 2 * k
        ));
        let content = content(page);
        objects.push(format!("<< /Length {} >>\nstream\n{content}endstream", content.len()));
    }
    file(&objects)
}

/// The drawing of a page, as operators.
fn content(page: &Page) -> String {
    let height = page.paper.height;
    let at = |[x, y]: [f64; 2]| format!("{:.3} {:.3}", x * PER_MM, (height - y) * PER_MM);
    let mut out = String::new();
    for drawn in &page.drawn {
        match drawn {
            Drawn::Line { points, width, dash } => {
                let dash =
                    if *dash > 0.0 { format!("[{:.3}]", dash * PER_MM) } else { "[]".to_owned() };
                let _ = write!(out, "{:.3} w {dash} 0 d ", width * PER_MM);
                for (k, point) in points.iter().enumerate() {
                    let _ = write!(out, "{} {} ", at(*point), if k == 0 { "m" } else { "l" });
                }
                out += "S\n";
            }
            Drawn::Words { at: place, size, text } => {
                let size = size * PER_MM;
                let _ =
                    writeln!(out, "BT /F1 {size:.3} Tf {} Td ({}) Tj ET", at(*place), plain(text));
            }
        }
    }
    out
}

/// A text in letters that every printer has.
fn plain(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '(' | ')' | '\\' => out.extend(['\\', c]),
            ' '..='~' => out.push(c),
            '−' | '–' => out.push('-'),
            '²' => out.push('2'),
            'µ' => out.push('u'),
            _ => out.push('?'),
        }
    }
    out
}

/// Objects with their table.
fn file(objects: &[String]) -> Vec<u8> {
    let mut out = String::from("%PDF-1.4\n");
    let mut offsets = vec![];
    for (k, object) in objects.iter().enumerate() {
        offsets.push(out.len());
        let _ = write!(out, "{} 0 obj\n{object}\nendobj\n", k + 1);
    }
    let table = out.len();
    let _ = write!(out, "xref\n0 {}\n0000000000 65535 f \n", objects.len() + 1);
    for offset in offsets {
        let _ = writeln!(out, "{offset:010} 00000 n ");
    }
    let count = objects.len() + 1;
    let _ = write!(out, "trailer\n<< /Size {count} /Root 1 0 R >>\nstartxref\n{table}\n%%EOF\n");
    out.into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::template::sheet::PAPERS;

    /// Every object begins where the table says, and a page is as large as its paper.
    #[test]
    fn the_table_finds_every_object() {
        let mut page = Page::new(PAPERS[0]);
        page.line(vec![[0.0, 0.0], [100.0, 0.0]], 0.2, 0.0);
        page.words([10.0, 10.0], 4.0, "100 mm (\\) ½");
        let file = String::from_utf8(pdf(&[page.clone(), page])).unwrap();
        let table: usize =
            file.rsplit("startxref\n").next().unwrap().lines().next().unwrap().parse().unwrap();
        assert!(file[table..].starts_with("xref\n0 8\n"));
        let lines = file[table..].lines().skip(3).take(7);
        for (k, line) in lines.enumerate() {
            let offset: usize = line[..10].parse().unwrap();
            assert!(file[offset..].starts_with(&format!("{} 0 obj", k + 1)), "{line}");
        }
        assert!(file.contains("/MediaBox [0 0 841.890 595.276]"), "{file}");
        assert!(file.contains("(100 mm \\(\\\\\\) ?)"));
    }
}
