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
    // How far a neighbourhood covers a space is known when the space is made.
    Known { folder: "xca-process/src", files: &["geometry/cover.rs", "geometry.rs"] },
    // The body of a process is a tree: blocks hold expressions, and expressions blocks.
    Known { folder: "xca-process/src", files: &["ir/expression.rs", "ir.rs", "ir_constant.rs"] },
    // Rows, and the search in them.
    Known {
        folder: "xca-process/src",
        files: &[
            "kernel/cells.rs",
            "kernel/entries.rs",
            "kernel/near.rs",
            "kernel/search.rs",
            "kernel/space.rs",
            "kernel/wide.rs",
            "kernel.rs",
        ],
    },
    // Values, and the blocks in which they are written.
    Known { folder: "xca-process/src", files: &["kernel/values.rs", "kernel/written.rs"] },
    // A model holds steering, which acts on a state, which is a state of a model.
    Known {
        folder: "xca-core/src",
        files: &[
            "engine/fault.rs",
            "engine/input.rs",
            "engine.rs",
            "model/builder.rs",
            "model/check.rs",
            "model/filling.rs",
            "model/names.rs",
            "model.rs",
            "plan.rs",
            "state.rs",
            "steering.rs",
        ],
    },
    // A simulation gives snapshots, and begins with them.
    Known { folder: "xca-core/src", files: &["simulation/snapshot.rs", "simulation.rs"] },
    // Expressions hold statements, and the words for both are shared.
    Known {
        folder: "xca-macros/src",
        files: &[
            "data/loops.rs",
            "data/words.rs",
            "data.rs",
            "fields.rs",
            "native/blocks.rs",
            "native/body.rs",
            "native/check.rs",
            "native/helper.rs",
            "native/kernels.rs",
            "native/loops.rs",
            "native/unrolled.rs",
            "native/work.rs",
            "native.rs",
        ],
    },
    // Expressions hold statements, and statements expressions.
    Known {
        folder: "xca-macros/src",
        files: &["parse/calls.rs", "parse/expressions.rs", "parse/places.rs", "parse/statements.rs"],
    },
    // Signatures, and the functions that have them.
    Known { folder: "xca-macros/src", files: &["parse/signature.rs", "parse.rs"] },
    // Formats write what a recorder shows them, and a recorder holds formats.
    Known {
        folder: "xca-record/src",
        files: &[
            "format/ascii_grid.rs",
            "format/extended_xyz.rs",
            "format/file.rs",
            "format/formats.rs",
            "format/geotiff.rs",
            "format/pictures.rs",
            "format/saved_view.rs",
            "format/space_time.rs",
            "format/subject.rs",
            "format/table.rs",
            "format/vtk.rs",
            "format.rs",
            "record/folder/error.rs",
            "record/folder/owner.rs",
            "record/folder.rs",
            "record/layer.rs",
            "record/painting.rs",
            "record/saved.rs",
            "record.rs",
            "set_up.rs",
        ],
    },
    // `resume`, `render` and `inspect` read the command line of an earlier run as it was read then.
    Known {
        folder: "xca-run/src",
        files: &[
            "command/clashes.rs",
            "command/inspect/frames.rs",
            "command/inspect.rs",
            "command/parse.rs",
            "command/render/kept.rs",
            "command/resume.rs",
        ],
    },
    // The command `watch`, with the feature that it needs.
    Known { folder: "xca-run/src", files: &["command/watch/show.rs", "command/watch.rs"] },
];
