//! Where a mutant can be planted, and which one.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Block, Expr, Item, Lit, ReturnType, Signature, Stmt, UnOp};

use crate::Result;

/// One error that can be planted.
#[derive(Debug, Clone)]
pub struct Site {
    /// Its file, from the package's root.
    pub file: PathBuf,
    /// The bytes that it replaces.
    pub range: Range<usize>,
    /// The line there.
    pub line: usize,
    pub change: Change,
    /// Text before and after, for the table.
    pub what: String,
}

impl std::fmt::Display for Site {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}:{}\t{}", self.file.display(), self.line, self.what)
    }
}

/// How an error is switched.
#[derive(Debug, Clone)]
pub enum Change {
    /// An expression by another.
    Expression(String),
    /// A removed statement.
    Removal,
    /// A statement put in.
    Insertion(String),
}

/// All sites in the Rust files of a folder and of those in it, in the order of the files.
pub fn of_folder(root: &Path, folder: &Path) -> Result<Vec<Site>> {
    let entries: std::io::Result<Vec<_>> = fs::read_dir(root.join(folder))?.collect();
    let mut names: Vec<_> = entries?.into_iter().map(|e| e.file_name()).collect();
    names.sort();
    let mut sites = Vec::new();
    for name in names.iter().map(Path::new) {
        let file = folder.join(name);
        if root.join(&file).is_dir() {
            sites.append(&mut of_folder(root, &file)?);
        // `arpack.rs` is only built with the feature of that name.
        } else if name.extension().is_some_and(|e| e == "rs") && name != Path::new("arpack.rs") {
            let text = fs::read_to_string(root.join(&file))?;
            let mut finder = Finder { file, text: &text, sites: vec![] };
            finder.visit_file(&syn::parse_file(&text)?);
            sites.append(&mut finder.sites);
        }
    }
    Ok(sites)
}

/// `count` of the places, by a seed: Fisher and Yates' shuffle with splitmix64.
pub fn drawn(mut sites: Vec<Site>, seed: u64, count: usize) -> Vec<Site> {
    let mut state = seed;
    let mut random = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as usize
    };
    let count = count.min(sites.len());
    for k in 0..count {
        let other = k + random() % (sites.len() - k);
        sites.swap(k, other);
    }
    sites.truncate(count);
    sites.sort_by(|a, b| (&a.file, a.range.start).cmp(&(&b.file, b.range.start)));
    sites
}

struct Finder<'a> {
    file: PathBuf,
    text: &'a str,
    sites: Vec<Site>,
}

impl Finder<'_> {
    fn source(&self, part: &impl Spanned) -> &str {
        &self.text[part.span().byte_range()]
    }

    fn add(&mut self, range: Range<usize>, change: Change, what: String) {
        let line = self.text[..range.start].matches('\n').count() + 1;
        let what = what.split_whitespace().collect::<Vec<_>>().join(" ");
        self.sites.push(Site { file: self.file.clone(), range, line, change, what });
    }

    fn swap(&mut self, expr: &Expr, other: String) {
        let what = format!("{} → {other}", self.source(expr));
        self.add(expr.span().byte_range(), Change::Expression(other), what);
    }

    fn binary(&mut self, e: &syn::ExprBinary, whole: &Expr) {
        let others: &[&str] = match e.op {
            BinOp::Add(_) => &["-"],
            BinOp::Sub(_) => &["+"],
            BinOp::Mul(_) => &["/"],
            BinOp::Div(_) | BinOp::Rem(_) => &["*"],
            BinOp::AddAssign(_) => &["-="],
            BinOp::SubAssign(_) => &["+="],
            BinOp::MulAssign(_) => &["/="],
            BinOp::DivAssign(_) => &["*="],
            BinOp::Lt(_) => &["<=", ">"],
            BinOp::Le(_) => &["<", ">"],
            BinOp::Gt(_) => &[">=", "<"],
            BinOp::Ge(_) => &[">", "<"],
            BinOp::Eq(_) => &["!="],
            BinOp::Ne(_) => &["=="],
            BinOp::And(_) => &["||"],
            BinOp::Or(_) => &["&&"],
            _ => &[],
        };
        for other in others {
            let changed = format!("{} {other} {}", self.source(&e.left), self.source(&e.right));
            self.swap(whole, changed);
        }
        // One of the two terms alone.
        if matches!(e.op, BinOp::Add(_) | BinOp::Sub(_)) {
            let left = self.source(&e.left).to_owned();
            self.swap(whole, left);
        }
    }

    fn literal(&mut self, literal: &Lit, whole: &Expr) {
        match literal {
            Lit::Int(n) => {
                let Ok(value) = n.base10_parse::<u64>() else { return };
                self.swap(whole, format!("{}{}", value + 1, n.suffix()));
                if value > 0 {
                    self.swap(whole, format!("{}{}", value - 1, n.suffix()));
                }
            }
            Lit::Float(x) if x.base10_parse::<f64>().is_ok_and(|x| x == 0.0) => {
                self.swap(whole, "1.0".to_owned());
            }
            Lit::Float(_) => {
                let source = self.source(whole).to_owned();
                self.swap(whole, format!("2.0 * {source}"));
                self.swap(whole, format!("-{source}"));
            }
            Lit::Bool(b) => self.swap(whole, (!b.value).to_string()),
            _ => {}
        }
    }

    fn method(&mut self, call: &syn::ExprMethodCall, whole: &Expr) {
        let name = call.method.to_string();
        let other = match name.as_str() {
            "min" => "max",
            "max" => "min",
            "sin" => "cos",
            "cos" => "sin",
            "abs" | "sqrt" => "",
            _ => return,
        };
        let (source, dot) = (self.source(whole), call.dot_token.span().byte_range().start);
        let start = whole.span().byte_range().start;
        let receiver = &source[..dot - start];
        let changed = match other {
            "" => receiver.to_owned(),
            other => {
                let after = call.method.span().byte_range().end - start;
                format!("{receiver}.{other}{}", &source[after..])
            }
        };
        self.swap(whole, changed);
    }

    /// A function that returns at once, where its type has a trivial value.
    fn body(&mut self, signature: &Signature, block: &Block) {
        let ReturnType::Type(_, of) = &signature.output else { return };
        let of = self.source(of);
        let value = match of {
            "bool" => "true",
            "f64" => "1.0",
            "usize" => "1",
            of if of.starts_with("Option<") => "None",
            _ => return,
        };
        let place = block.brace_token.span.open().byte_range().end;
        let what = format!("fn {} → {value}", signature.ident);
        self.add(place..place, Change::Insertion(format!("return {value};")), what);
    }

    fn condition(&mut self, condition: &Expr) {
        if !has_let(condition) {
            let source = self.source(condition).to_owned();
            self.swap(condition, format!("!({source})"));
        }
    }
}

/// Whether a condition binds names, which an expression in parentheses cannot.
fn has_let(e: &Expr) -> bool {
    match e {
        Expr::Let(_) => true,
        Expr::Binary(e) => has_let(&e.left) || has_let(&e.right),
        _ => false,
    }
}

/// Tests, and code that is only built with a feature.
fn is_left_out(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|a| a.path().is_ident("cfg"))
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_item(&mut self, item: &'ast Item) {
        match item {
            Item::Mod(m) if is_left_out(&m.attrs) => {}
            Item::Fn(f) if is_left_out(&f.attrs) || f.sig.constness.is_some() => {}
            Item::Fn(_) | Item::Impl(_) | Item::Mod(_) | Item::Trait(_) => {
                visit::visit_item(self, item);
            }
            // Constants and types: planted errors are switched at run time.
            _ => {}
        }
    }

    fn visit_item_fn(&mut self, f: &'ast syn::ItemFn) {
        self.body(&f.sig, &f.block);
        self.visit_block(&f.block);
    }

    fn visit_impl_item_fn(&mut self, f: &'ast syn::ImplItemFn) {
        if f.sig.constness.is_none() && !is_left_out(&f.attrs) {
            self.body(&f.sig, &f.block);
            self.visit_block(&f.block);
        }
    }

    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_path(&mut self, _: &'ast syn::Path) {}
    fn visit_angle_bracketed_generic_arguments(
        &mut self,
        _: &'ast syn::AngleBracketedGenericArguments,
    ) {
    }
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}

    fn visit_expr_repeat(&mut self, e: &'ast syn::ExprRepeat) {
        self.visit_expr(&e.expr);
    }

    fn visit_stmt(&mut self, statement: &'ast Stmt) {
        if let Stmt::Expr(
            Expr::Call(_)
            | Expr::MethodCall(_)
            | Expr::Assign(_)
            | Expr::Binary(_)
            | Expr::Return(_)
            | Expr::Break(_)
            | Expr::Continue(_),
            Some(_),
        ) = statement
        {
            let what = format!("{} → (left out)", self.source(statement));
            self.add(statement.span().byte_range(), Change::Removal, what);
        }
        visit::visit_stmt(self, statement);
    }

    fn visit_expr(&mut self, whole: &'ast Expr) {
        match whole {
            Expr::Binary(e) if !has_let(whole) => self.binary(e, whole),
            Expr::Unary(e) if matches!(e.op, UnOp::Neg(_) | UnOp::Not(_)) => {
                let source = self.source(&e.expr).to_owned();
                self.swap(whole, source);
            }
            Expr::Lit(e) => self.literal(&e.lit, whole),
            Expr::MethodCall(call) => self.method(call, whole),
            Expr::If(e) => self.condition(&e.cond),
            _ => {}
        }
        visit::visit_expr(self, whole);
    }
}
