//! Scripts and styles of the page, built beforehand and part of the program.

use axum::{
    extract::Path,
    http::{HeaderMap, HeaderValue, StatusCode, header},
    response::{IntoResponse, Response},
};
use rust_embed::{EmbeddedFile, RustEmbed};

use crate::{http, problem::Problem};

#[derive(RustEmbed)]
#[folder = "web/dist"]
struct Assets;

/// The page before its data are put in.
pub(crate) fn template() -> String {
    let page = Assets::get("index.html").map(|file| file.data.into_owned());
    String::from_utf8(page.unwrap_or_default()).unwrap_or_default()
}

/// `GET /assets/{name}`.
pub(crate) async fn get(Path(name): Path<String>, headers: HeaderMap) -> Response {
    let kind = match name.rsplit('.').next() {
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        _ => return missing().into_response(),
    };
    match Assets::get(&name) {
        Some(file) => asset(kind, file, &headers),
        None => missing().into_response(),
    }
}

fn asset(kind: &'static str, file: EmbeddedFile, headers: &HeaderMap) -> Response {
    let hash = file.metadata.sha256_hash();
    let tag: String = hash
        .iter()
        .take(12)
        .map(|byte| format!("{byte:02x}"))
        .collect();
    let tag = format!("\"{tag}\"");
    let known = headers
        .get(header::IF_NONE_MATCH)
        .map(HeaderValue::as_bytes);
    let mut response = match known == Some(tag.as_bytes()) {
        true => http::respond(StatusCode::NOT_MODIFIED, kind, ""),
        false => http::respond(StatusCode::OK, kind, file.data.into_owned()),
    };
    let headers = response.headers_mut();
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-cache"));
    if let Ok(tag) = HeaderValue::from_str(&tag) {
        headers.insert(header::ETAG, tag);
    }
    response
}

pub(crate) fn missing() -> Problem {
    Problem::with_status(StatusCode::NOT_FOUND, "there is no such page", "go to `/`")
}
