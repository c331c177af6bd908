//! The modules of a crate, as its files declare them, and what each names of the others.

use crate::components::Uses;
use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use syn::{Attribute, Item, UseTree, Visibility};

/// A module, in a file of its own or within one.
#[derive(Debug, Default)]
pub(crate) struct Module {
    /// Its names from the root of the crate on.
    path: Vec<String>,
    file: PathBuf,
    children: BTreeMap<String, usize>,
    /// What is defined here.
    items: BTreeSet<String>,
    /// What is brought in, by the name that it has here: a path from the root.
    imports: BTreeMap<String, Vec<String>>,
    /// Modules all of whose names are brought in.
    globs: Vec<Vec<String>>,
    /// What is used, as paths from the root.
    uses: Vec<Vec<String>>,
}

/// The modules of a crate; the first one is its root.
#[derive(Debug, Default)]
pub(crate) struct Crate {
    modules: Vec<Module>,
}

/// A name is not handed on more often.
const MOST_EXPORTS: usize = 8;

/// Whether it is compiled for tests only.
fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let meta = &attribute.meta;
        meta.path().is_ident("cfg") && meta.require_list().is_ok_and(|list| list.tokens.to_string() == "test")
    })
}

/// An import: its path from the present module on, and its name there; no name for all names of a module.
struct Import {
    path: Vec<String>,
    name: Option<String>,
}

fn flatten(tree: &UseTree, before: &[String], imports: &mut Vec<Import>) {
    let with = |ident: &syn::Ident| [before, &[ident.to_string()]].concat();
    match tree {
        UseTree::Path(path) => flatten(&path.tree, &with(&path.ident), imports),
        UseTree::Name(name) if name.ident == "self" => {
            imports.push(Import { path: before.to_vec(), name: before.last().cloned() });
        }
        UseTree::Name(name) => {
            imports.push(Import { path: with(&name.ident), name: Some(name.ident.to_string()) });
        }
        UseTree::Rename(rename) => {
            imports.push(Import { path: with(&rename.ident), name: Some(rename.rename.to_string()) });
        }
        UseTree::Glob(_) => imports.push(Import { path: before.to_vec(), name: None }),
        UseTree::Group(group) => group.items.iter().for_each(|tree| flatten(tree, before, imports)),
    }
}

/// The paths in tokens: names between `::`, but for those behind a point.
fn paths(tokens: TokenStream, found: &mut Vec<Vec<String>>) {
    let mut path: Vec<String> = Vec::new();
    let mut colons = 0;
    let mut after_point = false;
    for token in tokens {
        match token {
            TokenTree::Punct(punct) if punct.as_char() == ':' => {
                colons += 1;
                continue;
            }
            TokenTree::Ident(ident) => {
                if colons != 2 {
                    found.push(std::mem::take(&mut path));
                }
                if !after_point {
                    path.push(ident.to_string());
                }
                after_point = false;
            }
            TokenTree::Punct(punct) => {
                found.push(std::mem::take(&mut path));
                after_point = punct.as_char() == '.';
            }
            TokenTree::Group(group) => {
                found.push(std::mem::take(&mut path));
                after_point = false;
                // An attribute and a visibility are in groups too; their paths name modules, which are no
                // uses.
                let is_visibility = group.delimiter() == Delimiter::Parenthesis
                    && group.stream().to_string().starts_with("in ");
                if !is_visibility {
                    paths(group.stream(), found);
                }
            }
            TokenTree::Literal(_) => {
                found.push(std::mem::take(&mut path));
                after_point = false;
            }
        }
        colons = 0;
    }
    found.push(path);
    found.retain(|path| !path.is_empty());
}

/// The name of what an item defines.
fn name(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::TraitAlias(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        _ => return None,
    };
    Some(ident.to_string())
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

impl Crate {
    /// Reads a crate from the file of its root on.
    pub(crate) fn read(root: &Path) -> Result<Self, Box<dyn Error>> {
        let mut this = Self::default();
        let folder = root.parent().ok_or("a root without a folder")?.to_owned();
        this.read_file(Vec::new(), root, &folder)?;
        Ok(this)
    }

    fn read_file(&mut self, path: Vec<String>, file: &Path, folder: &Path) -> Result<usize, Box<dyn Error>> {
        let parsed = syn::parse_file(&fs::read_to_string(file)?)
            .map_err(|error| format!("{}: {error}", file.display()))?;
        self.read_items(path, file, folder, parsed.items)
    }

    /// Reads a module, whose modules in files of their own are in the folder.
    fn read_items(
        &mut self,
        path: Vec<String>,
        file: &Path,
        folder: &Path,
        items: Vec<Item>,
    ) -> Result<usize, Box<dyn Error>> {
        let at = self.modules.len();
        self.modules.push(Module { path: path.clone(), file: file.to_owned(), ..Module::default() });
        let mut words = Vec::new();
        let mut imports: Vec<(Import, bool)> = Vec::new();
        for item in items {
            if is_test(attributes(&item)) {
                continue;
            }
            self.modules[at].items.extend(name(&item));
            match item {
                Item::Mod(module) => {
                    let name = module.ident.to_string();
                    let (path, below) =
                        ([&path[..], std::slice::from_ref(&name)].concat(), folder.join(&name));
                    let child = match module.content {
                        Some((_, items)) => self.read_items(path, file, &below, items)?,
                        None => {
                            let files = [folder.join(format!("{name}.rs")), below.join("mod.rs")];
                            let file = files.iter().find(|file| file.exists());
                            let file = file.ok_or_else(|| {
                                format!("module {name} has no file in {}", folder.display())
                            })?;
                            self.read_file(path, file, &below)?
                        }
                    };
                    self.modules[at].children.insert(name, child);
                }
                Item::Use(item) => {
                    let mut found = Vec::new();
                    flatten(&item.tree, &[], &mut found);
                    let is_public = !matches!(item.vis, Visibility::Inherited);
                    imports.extend(found.into_iter().map(|import| (import, is_public)));
                }
                item => {
                    if let Item::Macro(definition) = &item
                        && definition.attrs.iter().any(|attribute| attribute.path().is_ident("macro_export"))
                        && let Some(name) = &definition.ident
                        && at > 0
                    {
                        // Such a macro belongs to the root.
                        let target = [&path[..], &[name.to_string()]].concat();
                        self.modules[0].imports.insert(name.to_string(), target);
                    }
                    paths(quote::ToTokens::into_token_stream(item), &mut words);
                }
            }
        }
        self.bring_in(at, imports, &words);
        let found = words.iter().filter(|words| words.len() > 1);
        let uses: Vec<Vec<String>> = found.filter_map(|words| self.absolute(at, words)).collect();
        self.modules[at].uses.extend(uses);
        Ok(at)
    }

    fn bring_in(&mut self, at: usize, imports: Vec<(Import, bool)>, words: &[Vec<String>]) {
        for (Import { path, name }, is_public) in imports {
            let Some(target) = self.absolute(at, &path) else { continue };
            let module = &mut self.modules[at];
            // What is only handed on from a module below is not used here.
            let is_below = target.len() > module.path.len() && target.starts_with(&module.path);
            let is_used = words.iter().any(|words| name.as_ref() == words.first());
            match name {
                _ if is_public && is_below && !is_used => {}
                _ => module.uses.push(target.clone()),
            }
            match name {
                Some(name) => drop(module.imports.insert(name, target)),
                None => module.globs.push(target),
            }
        }
    }

    /// A path from the root on; none for what is of another crate.
    fn absolute(&self, at: usize, path: &[String]) -> Option<Vec<String>> {
        let module = &self.modules[at];
        let (first, rest) = path.split_first()?;
        let mut base = match first.as_str() {
            "crate" => Vec::new(),
            "self" => module.path.clone(),
            "super" => module.path.split_last()?.1.to_vec(),
            name if module.children.contains_key(name) => [&module.path[..], &[name.to_owned()]].concat(),
            name => module.imports.get(name)?.clone(),
        };
        let above = rest.iter().take_while(|name| *name == "super").count();
        base.truncate(base.len().checked_sub(above)?);
        base.extend(rest[above..].iter().cloned());
        Some(base)
    }

    /// The module that defines what a path names: none if that is a module itself.
    fn definition(&self, path: &[String], depth: usize) -> Option<usize> {
        let mut at = 0;
        for (place, name) in path.iter().enumerate() {
            let module = &self.modules[at];
            if let Some(child) = module.children.get(name) {
                at = *child;
                continue;
            }
            if module.items.contains(name) || depth == 0 {
                return Some(at);
            }
            if let Some(target) = module.imports.get(name) {
                let whole = [&target[..], &path[place + 1..]].concat();
                return self.definition(&whole, depth - 1);
            }
            let known = module.globs.iter().find_map(|glob| {
                let target = self.module(glob)?;
                let there = &self.modules[target];
                let has = there.items.contains(name)
                    || there.imports.contains_key(name)
                    || there.children.contains_key(name);
                has.then(|| [&glob[..], &path[place..]].concat())
            });
            return match known {
                Some(whole) => self.definition(&whole, depth - 1),
                None => Some(at),
            };
        }
        None
    }

    /// The module of this path.
    fn module(&self, path: &[String]) -> Option<usize> {
        path.iter().try_fold(0, |at, name| self.modules[at].children.get(name).copied())
    }

    /// For each file, what it uses of the other files of the crate.
    pub(crate) fn uses(&self) -> Uses<PathBuf> {
        let mut all = Uses::new();
        for module in &self.modules {
            let of_file = all.entry(module.file.clone()).or_default();
            for path in &module.uses {
                // All names of a module.
                let globbed = module.globs.contains(path).then(|| self.module(path)).flatten();
                let Some(target) = globbed.or_else(|| self.definition(path, MOST_EXPORTS)) else { continue };
                let file = &self.modules[target].file;
                if *file != module.file {
                    let name = path.last().cloned().unwrap_or_default();
                    of_file.entry(file.clone()).or_default().insert(name);
                }
            }
        }
        all
    }
}
