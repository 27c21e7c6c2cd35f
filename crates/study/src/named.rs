//! Enumerations whose variants have names.

/// An enumeration by one list of its variants and their names: all of them, the name of each, and its form in JSON
/// follow.
macro_rules! named {
    ($(#[$meta:meta])* pub enum $kind:ident { $($(#[$said:meta])* $variant:ident = $name:literal,)+ }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ::serde::Serialize)]
        pub enum $kind {
            $($(#[$said])* #[serde(rename = $name)] $variant,)+
        }

        impl $kind {
            /// All of them, in order.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            /// Its name for people and in files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }
        }
    };
}
pub(crate) use named;
