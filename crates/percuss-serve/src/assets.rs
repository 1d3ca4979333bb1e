//! Scripts and styles of the page, embedded in the program.

use std::hash::{DefaultHasher, Hash, Hasher};

use axum::{
    extract::Path,
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};

use crate::{http, problem::Problem};

/// Names and contents of the files in `web/dist`.
const FILES: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/page.rs"));

fn file(name: &str) -> Option<&'static [u8]> {
    let found = FILES.iter().find(|(known, _)| *known == name);
    found.map(|(_, content)| *content)
}

/// A page before its data are put in.
pub(crate) fn template(name: &str) -> String {
    String::from_utf8_lossy(file(name).unwrap_or_default()).into_owned()
}

/// `GET /assets/{name}`.
pub(crate) async fn get(Path(name): Path<String>, headers: HeaderMap) -> Response {
    let kind = match name.rsplit('.').next() {
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => return missing().into_response(),
    };
    match file(&name) {
        Some(content) => asset(kind, content, &headers),
        None => missing().into_response(),
    }
}

fn asset(kind: &'static str, content: &'static [u8], headers: &HeaderMap) -> Response {
    let mut hash = DefaultHasher::new();
    content.hash(&mut hash);
    let tag = format!("\"{:016x}\"", hash.finish());
    let known = headers
        .get(header::IF_NONE_MATCH)
        .map(HeaderValue::as_bytes);
    let mut response = match known == Some(tag.as_bytes()) {
        true => http::respond(StatusCode::NOT_MODIFIED, kind, ""),
        false => http::respond(StatusCode::OK, kind, content),
    };
    let headers = response.headers_mut();
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-cache"));
    if let Ok(tag) = HeaderValue::from_str(&tag) {
        headers.insert(header::ETAG, tag);
    }
    response
}

/// Answer to any other address: a page to a browser.
pub(crate) async fn fallback(headers: HeaderMap) -> Response {
    let accepts = headers.get(header::ACCEPT).map(HeaderValue::as_bytes);
    let accepts = String::from_utf8_lossy(accepts.unwrap_or_default());
    match accepts.contains("text/html") {
        true => missing().page(),
        false => missing().into_response(),
    }
}

pub(crate) fn missing() -> Problem {
    Problem::with_status(
        StatusCode::NOT_FOUND,
        "there is no such page",
        "go back to the page of the case",
    )
}
