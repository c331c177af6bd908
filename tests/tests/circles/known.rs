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
    // Statements hold expressions, which call routines, which are written like statements.
    Known {
        folder: "xca-wgsl/src",
        files: &[
            "buffer.rs",
            "declarations.rs",
            "entry.rs",
            "glossary.rs",
            "literal.rs",
            "module.rs",
            "print/constant.rs",
            "print/element.rs",
            "print/expression.rs",
            "print/loops.rs",
            "print/mod.rs",
            "print/range.rs",
            "print/statement.rs",
            "routine.rs",
            "shader.rs",
        ],
    },
    // The types of operators follow from those of their operands, and the other way round.
    Known { folder: "xca-wgsl/src", files: &["inference/mod.rs", "inference/operators.rs"] },
    // Items, and the lists of what is near them.
    Known {
        folder: "xca-cpu/src",
        files: &["blocks.rs", "listing.rs", "lists.rs", "motion.rs", "population.rs", "upkeep.rs"],
    },
    // A device, and the code that it compiles.
    Known { folder: "xca-gpu/src", files: &["device/code.rs", "device.rs", "error.rs"] },
    // A screen, and the words on it.
    Known { folder: "xca-watch/src", files: &["screen.rs", "words.rs"] },
    // A site, and what it sees around.
    Known { folder: "tests/src", files: &["suite/around.rs", "suite/site.rs"] },
    // What is measured, and another program beside it.
    Known { folder: "benchmarks/src", files: &["lammps.rs", "particles.rs"] },
];
