//! The layers of the core: which folder may import from which, and no circle among files.
//!
//! Every `use crate::…`, `use super::…` and every path that begins with `crate::` is read from the sources, in unit tests
//! too. (The page's own layers are held by `www/unit/layers.test.ts`.)

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// The layers from the top to the bottom. A file imports from its own folder and from the lines below it.
const LAYERS: [&[&str]; 7] = [
    &["command", "web"],
    &["batch", "live", "reproduction"],
    &["measurement"],
    &["stability", "simulation"],
    &["scenario"],
    &["format", "plot"],
    &["numerics", "error"],
];

/// Modules directly under `src/`; more would be a list, not a structure.
const MOST_MODULES: usize = 13;

/// Every source file with its module path, `["stability", "roots"]`; a folder's `mod.rs` has the folder's.
fn sources() -> BTreeMap<Vec<String>, String> {
    fn collect(folder: &Path, module: &[String], found: &mut BTreeMap<Vec<String>, String>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            let mut inside = module.to_vec();
            if path.is_dir() {
                inside.push(name);
                collect(&path, &inside, found);
                continue;
            }
            match name.as_str() {
                "mod" => {}
                "lib" | "main" if module.is_empty() => continue,
                name => match name.strip_suffix("_tests") {
                    Some(tested) => inside.extend([tested.to_owned(), "tests".to_owned()]),
                    None => inside.push(name.to_owned()),
                },
            }
            found.insert(inside, fs::read_to_string(&path).unwrap());
        }
    }
    let mut found = BTreeMap::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &[], &mut found);
    found
}

/// The paths of a `use`, braces expanded: `a::{b, c::D}` gives `a::b` and `a::c::D`.
fn expanded(path: &str) -> Vec<String> {
    let Some(open) = path.find('{') else {
        return vec![path.split(" as ").next().unwrap().trim().to_owned()];
    };
    let (prefix, inside) = (&path[..open], &path[open + 1..path.rfind('}').unwrap()]);
    let (mut parts, mut depth, mut start) = (Vec::new(), 0, 0);
    for (k, c) in inside.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&inside[start..k]);
                start = k + 1;
            }
            _ => {}
        }
    }
    parts.push(&inside[start..]);
    parts
        .iter()
        .filter(|p| !p.trim().is_empty())
        .flat_map(|p| expanded(&format!("{prefix}{}", p.trim())))
        .collect()
}

/// Absolute module paths that a file names, from its `use` lines and from paths in its code.
fn imports(module: &[String], text: &str) -> Vec<Vec<String>> {
    let mut found = Vec::new();
    // Inline modules that are open: their names and how far they are indented.
    let mut inline: Vec<(String, usize)> = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let code = line.split("//").next().unwrap();
        let (indent, code) = (code.len() - code.trim_start().len(), code.trim());
        if inline.last().is_some_and(|(_, depth)| code == "}" && indent == *depth) {
            inline.pop();
        }
        let bare = code
            .trim_start_matches("pub ")
            .trim_start_matches("pub(crate) ")
            .trim_start_matches("pub(super) ");
        if let Some(name) = bare.strip_prefix("mod ").and_then(|rest| rest.strip_suffix(" {")) {
            inline.push((name.to_owned(), indent));
            continue;
        }
        let here: Vec<String> =
            module.iter().cloned().chain(inline.iter().map(|(name, _)| name.clone())).collect();
        if code.starts_with("pub use ") && module.len() == 1 {
            continue; // what a folder's `mod.rs` offers under a shorter name
        }
        let paths = if let Some(first) = bare.strip_prefix("use ") {
            let mut statement = first.to_owned();
            while !statement.contains(';') {
                statement.push_str(lines.next().unwrap().split("//").next().unwrap().trim());
            }
            expanded(statement.trim_end_matches(';'))
        } else {
            ["crate::", "super::"]
                .iter()
                .flat_map(|start| code.match_indices(start))
                .filter(|(k, _)| {
                    !code[..*k].ends_with([':', '$']) && code[..*k].matches('"').count() % 2 == 0
                })
                .map(|(k, _)| {
                    let end = code[k..].find(|c: char| !c.is_alphanumeric() && c != '_' && c != ':');
                    code[k..end.map_or(code.len(), |end| k + end)].to_owned()
                })
                .collect()
        };
        for path in paths {
            let mut absolute = match path.split("::").next().unwrap() {
                "crate" => Vec::new(),
                "super" | "self" => here.clone(),
                _ => continue,
            };
            for part in path.split("::") {
                match part {
                    "crate" | "self" => {}
                    "super" => drop(absolute.pop()),
                    part => absolute.push(part.to_owned()),
                }
            }
            found.push(absolute);
        }
    }
    found
}

/// The file that a path leads into: the longest part of it that is one.
fn file_of(path: &[String], files: &BTreeMap<Vec<String>, String>) -> Option<Vec<String>> {
    (1..=path.len()).rev().map(|n| path[..n].to_vec()).find(|module| files.contains_key(module))
}

/// Every file with the files that it imports.
fn graph() -> BTreeMap<Vec<String>, BTreeSet<Vec<String>>> {
    let files = sources();
    let targets = |module: &Vec<String>, text: &String| {
        let own: BTreeSet<_> =
            imports(module, text).iter().filter_map(|path| file_of(path, &files)).collect();
        own.into_iter().filter(|target| target != module).collect()
    };
    files.iter().map(|(module, text)| (module.clone(), targets(module, text))).collect()
}

#[test]
fn imports_go_down_the_layers() {
    let line = |module: &Vec<String>| {
        LAYERS
            .iter()
            .position(|line| line.contains(&module[0].as_str()))
            .unwrap_or_else(|| panic!("{module:?} has no layer"))
    };
    let mut wrong = Vec::new();
    for (module, targets) in graph() {
        for target in targets {
            if target[0] != module[0] && line(&target) <= line(&module) {
                wrong.push(format!("{} imports {}", module.join("::"), target.join("::")));
            }
        }
    }
    assert!(wrong.is_empty(), "imports that go up or aside:\n{}", wrong.join("\n"));
}

#[test]
fn no_files_import_one_another_in_a_circle() {
    let mut graph = graph();
    // What imports nothing that is left cannot be part of a circle.
    loop {
        let done: Vec<_> =
            graph.iter().filter(|(_, t)| t.is_empty()).map(|(module, _)| module.clone()).collect();
        if done.is_empty() {
            break;
        }
        graph.retain(|module, _| !done.contains(module));
        for targets in graph.values_mut() {
            targets.retain(|target| !done.contains(target));
        }
    }
    // Nor what nothing that is left imports.
    loop {
        let used: BTreeSet<_> = graph.values().flatten().cloned().collect();
        let before = graph.len();
        graph.retain(|module, _| used.contains(module));
        if graph.len() == before {
            break;
        }
    }
    let names =
        |targets: &BTreeSet<Vec<String>>| targets.iter().map(|t| t.join("::")).collect::<Vec<_>>().join(", ");
    let circle: Vec<_> =
        graph.iter().map(|(module, t)| format!("{} imports {}", module.join("::"), names(t))).collect();
    assert!(circle.is_empty(), "files in circles:\n{}", circle.join("\n"));
}

#[test]
fn few_modules_stand_directly_under_the_root() {
    let top: BTreeSet<_> = sources().into_keys().map(|module| module[0].clone()).collect();
    assert!(top.len() <= MOST_MODULES, "{top:?}");
    assert_eq!(
        top,
        LAYERS.iter().copied().flatten().map(|&m| m.to_owned()).collect(),
        "a module without a layer, or a layer without a module"
    );
}

/// The reader of imports sees what it must, so that the tests above can fail.
#[test]
fn imports_are_read_from_every_form() {
    let text = "use crate::a::{b::C, d};\nuse super::e::F;\nlet x = crate::g::h();\n// crate::no::no\nmod tests {\n    use super::super::i;\n    use super::*;\n}\n";
    let module = ["m".to_owned(), "n".to_owned()];
    let found: Vec<_> = imports(&module, text).iter().map(|path| path.join("::")).collect();
    assert_eq!(found, ["a::b::C", "a::d", "m::e::F", "g::h", "m::i", "m::n::*"]);
}
