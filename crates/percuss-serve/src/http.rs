//! Responses and their headers.

use axum::{
    body::Body,
    http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header},
    response::Response,
};
use serde::Serialize;

/// Content policy of the page: its own scripts and styles, and nothing from elsewhere.
pub(crate) const PAGE_POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; \
     connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
/// Content policy of reports, which bring their styles and drawings with them and run nothing.
pub(crate) const REPORT_POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// A response with a body of a type.
pub(crate) fn respond(
    status: StatusCode,
    content_type: &'static str,
    body: impl Into<Body>,
) -> Response {
    let mut response = Response::new(body.into());
    *response.status_mut() = status;
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, HeaderValue::from_static(content_type));
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    response
}

/// A response that holds a value.
pub(crate) fn json(status: StatusCode, value: &impl Serialize) -> Response {
    // Every value that is answered has text keys and so can be written.
    let text = serde_json::to_vec(value).unwrap_or_default();
    respond(status, "application/json", text)
}

/// A page with scripts of its own.
pub(crate) fn page(html: String) -> Response {
    let mut response = respond(StatusCode::OK, "text/html; charset=utf-8", html);
    set_policy(response.headers_mut(), PAGE_POLICY);
    response
}

/// A report as a page, with the way back.
pub(crate) fn report(html: &str) -> Response {
    report_of(StatusCode::OK, html)
}

/// A report with a status.
pub(crate) fn report_of(status: StatusCode, html: &str) -> Response {
    const BACK: &str =
        "<main>\n<p><a href=\"/\">Case</a> · <a href=\"/materials\">Materials</a></p>\n";
    let html = html.replacen("<main>\n", BACK, 1);
    let mut response = respond(status, "text/html; charset=utf-8", html);
    set_policy(response.headers_mut(), REPORT_POLICY);
    response
}

pub(crate) fn set_policy(headers: &mut HeaderMap, policy: &'static str) {
    headers.insert(
        header::CONTENT_SECURITY_POLICY,
        HeaderValue::from_static(policy),
    );
}

/// Adds the headers that every response has.
pub(crate) fn protect(headers: &mut HeaderMap) {
    if !headers.contains_key(header::CONTENT_SECURITY_POLICY) {
        set_policy(headers, "default-src 'none'; frame-ancestors 'none'");
    }
    for (name, value) in [
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::X_FRAME_OPTIONS, "DENY"),
        (
            HeaderName::from_static("cross-origin-opener-policy"),
            "same-origin",
        ),
        (
            HeaderName::from_static("cross-origin-resource-policy"),
            "same-origin",
        ),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
}
