//! The book builds with every page and link in it.

use std::{
    fs,
    path::{Path, PathBuf},
};

use percuss_book::{build, repository};

#[test]
fn the_book_builds_and_every_link_leads_somewhere() {
    let out = tempfile::tempdir().unwrap();
    let first = build(&repository(), out.path()).unwrap();
    assert!(first.is_file());
    let html = out.path().join("html");
    let pages = files(&html.join("docs"), "html");
    assert!(pages.len() > 30, "{} pages", pages.len());
    let index = fs::read_dir(&html).unwrap();
    let mut index = index.map(|entry| entry.unwrap().file_name());
    let is_index = |name: &std::ffi::OsString| name.to_string_lossy().starts_with("searchindex");
    assert!(index.any(|name| is_index(&name)), "no index for the search");
    let page = fs::read_to_string(&pages[0]).unwrap();
    assert!(
        page.contains("id=\"mdbook-searchbar\""),
        "no box for the search"
    );
    let mut broken = Vec::new();
    for page in pages {
        let text = fs::read_to_string(&page).unwrap();
        let content = text.split("<main>").nth(1).unwrap_or_default();
        for link in ["href=\"", "src=\""]
            .into_iter()
            .flat_map(|mark| content.split(mark).skip(1))
        {
            let link = link.split('"').next().unwrap_or_default();
            let (place, part) = link.split_once('#').unwrap_or((link, ""));
            if place.contains("://") {
                continue;
            }
            let target = match place {
                "" => page.clone(),
                _ => page.parent().unwrap().join(place),
            };
            let has_part = part.is_empty()
                || fs::read_to_string(&target)
                    .is_ok_and(|text| text.contains(&format!("id=\"{part}\"")));
            if !target.exists() || !has_part {
                broken.push(format!("{}: {link}", page.display()));
            }
        }
    }
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}

/// Formulae are drawn by the browser itself: a page needs no script and no network for them.
#[test]
fn every_formula_of_the_book_is_mathml() {
    let out = tempfile::tempdir().unwrap();
    build(&repository(), out.path()).unwrap();
    let docs = repository().join("docs");
    let mut count = 0;
    for page in files(&docs, "md") {
        let formulae = fs::read_to_string(&page).unwrap().matches("$$").count() / 2;
        let name = page.strip_prefix(&docs).unwrap().with_extension("html");
        if formulae == 0 {
            continue;
        }
        let built = out.path().join("html/docs").join(&name);
        let html = fs::read_to_string(&built).unwrap();
        let content = html.split("<main>").nth(1).unwrap();
        let content = content.split("</main>").next().unwrap();
        assert!(!content.contains("$$"), "{}", name.display());
        assert_eq!(
            content.matches("<math ").count(),
            formulae,
            "{}",
            name.display()
        );
        assert_eq!(
            content.matches("</math>").count(),
            formulae,
            "{}",
            name.display()
        );
        assert!(
            !html.to_lowercase().contains("mathjax"),
            "{}",
            name.display()
        );
        count += formulae;
    }
    assert!(count >= 10, "{count} formulae");
}

#[test]
fn every_page_of_the_guide_is_in_the_contents() {
    let docs = repository().join("docs");
    let contents = fs::read_to_string(docs.join("SUMMARY.md")).unwrap();
    for page in files(&docs, "md") {
        let name = page
            .strip_prefix(&docs)
            .unwrap()
            .to_string_lossy()
            .replace('\\', "/");
        let listed = contents.contains(&format!("]({name})"));
        assert!(
            listed || name == "SUMMARY.md",
            "docs/SUMMARY.md lacks {name}"
        );
    }
}

/// All files below a folder with an extension.
fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|end| end == extension) {
            found.push(path);
        }
    }
    found
}
