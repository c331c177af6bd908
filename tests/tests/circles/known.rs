//! The circles that stay.

/// Files that use each other.
pub(crate) struct Known {
    /// The crate's folder of sources.
    folder: &'static str,
    pub(crate) files: &'static [&'static str],
}

impl Known {
    /// A file from the root of the workspace on.
    pub(crate) fn path(&self, file: &str) -> String {
        format!("{}/{file}", self.folder)
    }
}

/// Circles may become smaller. They must not grow.
pub(crate) const KNOWN: &[Known] = &[
    // Recursion: the body of a process is a tree. Blocks hold expressions; expressions hold blocks and call
    // functions; functions hold blocks.
    Known { folder: "xca-process/src", files: &["ir/expression.rs", "ir/function.rs", "ir/statement.rs"] },
    // Recursion: statements hold loops, which hold statements.
    Known { folder: "xca-macros/src", files: &["data/loops.rs", "data.rs"] },
    // Recursion: expressions hold statements, and statements expressions.
    Known {
        folder: "xca-macros/src",
        files: &["parse/calls.rs", "parse/expressions.rs", "parse/places.rs", "parse/statements.rs"],
    },
];
