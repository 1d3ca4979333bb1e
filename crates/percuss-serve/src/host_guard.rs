//! Check of requests: host name, origin and token.

use std::{net::IpAddr, sync::Arc};

use axum::{
    extract::{Request, State},
    http::{HeaderMap, HeaderValue, Method, StatusCode, Uri, header, uri::Authority},
    middleware::Next,
    response::{IntoResponse, Response},
};

use crate::{Options, connection::Visitor, http, problem::Problem};

/// Name of the cookie that holds the token.
const COOKIE: &str = "percuss_token";

/// Allowed hosts and token.
#[derive(Debug)]
pub(crate) struct HostGuard {
    token: Option<String>,
    /// Whether other machines may reach the server, by any of its addresses.
    remote: bool,
    host_names: Vec<String>,
}

impl HostGuard {
    pub(crate) fn new(options: &Options) -> Self {
        Self {
            token: options.token.clone(),
            remote: !options.address.ip().is_loopback(),
            host_names: options
                .host_names
                .iter()
                .map(|name| name.to_lowercase())
                .collect(),
        }
    }

    /// Passes a request on, or refuses it.
    pub(crate) async fn watch(
        State(guard): State<Arc<Self>>,
        request: Request,
        next: Next,
    ) -> Response {
        let mut response = match guard.check(request.method(), request.uri(), request.headers()) {
            Ok(()) => {
                if let Some(visitor) = request.extensions().get::<Visitor>() {
                    visitor.welcome();
                }
                next.run(request).await
            }
            Err(refusal) => *refusal,
        };
        http::protect(response.headers_mut());
        response
    }

    fn check(&self, method: &Method, uri: &Uri, headers: &HeaderMap) -> Result<(), Box<Response>> {
        let refuse = |problem: Problem| Box::new(problem.into_response());
        let host = self.host(uri, headers).map_err(refuse)?;
        check_origin(&host, uri, headers).map_err(refuse)?;
        self.check_token(method, uri, headers)
    }

    /// Host name of the request. A foreign name is a sign of DNS rebinding by a page of another site.
    fn host(&self, uri: &Uri, headers: &HeaderMap) -> Result<String, Problem> {
        let misdirected = || {
            Problem::with_status(
                StatusCode::MISDIRECTED_REQUEST,
                "the request names another host",
                "open the address that the terminal shows; `--host-name NAME` allows a name of this machine",
            )
        };
        let mut values = headers.get_all(header::HOST).iter();
        let (Some(value), None) = (values.next(), values.next()) else {
            return Err(misdirected());
        };
        let value = value.to_str().map_err(|_| misdirected())?;
        let authority: Authority = value.parse().map_err(|_| misdirected())?;
        if uri.authority().is_some_and(|named| *named != authority) || value.contains('@') {
            return Err(misdirected());
        }
        let name = authority.host().to_lowercase();
        let address: Option<IpAddr> = name.trim_matches(['[', ']']).parse().ok();
        let known = match address {
            Some(address) => self.remote || address.is_loopback(),
            None => name == "localhost" || self.host_names.contains(&name),
        };
        match known {
            true => Ok(value.to_lowercase()),
            false => Err(misdirected()),
        }
    }

    fn check_token(
        &self,
        method: &Method,
        uri: &Uri,
        headers: &HeaderMap,
    ) -> Result<(), Box<Response>> {
        let Some(token) = &self.token else {
            return Ok(());
        };
        if given_tokens(headers).any(|given| same(given, token)) {
            return Ok(());
        }
        let mut queries = uri.query().unwrap_or_default().split('&');
        let in_address = queries.find_map(|part| part.strip_prefix("token="));
        if method == Method::GET && in_address.is_some_and(|given| same(given, token)) {
            return Err(Box::new(remember(token, uri.path())));
        }
        Err(Box::new(
            Problem::with_status(
                StatusCode::UNAUTHORIZED,
                "the token is missing or wrong",
                "open the address followed by `?token=` and the token of this server",
            )
            .into_response(),
        ))
    }
}

/// Refuses requests of pages of other sites.
fn check_origin(host: &str, uri: &Uri, headers: &HeaderMap) -> Result<(), Problem> {
    let foreign = || {
        Problem::with_status(
            StatusCode::FORBIDDEN,
            "the request is from a page of another site",
            "open the address that the terminal shows",
        )
    };
    let mut origins = headers.get_all(header::ORIGIN).iter();
    let own = |origin: &HeaderValue| {
        let origin = origin.to_str().unwrap_or_default().to_lowercase();
        let name = origin
            .strip_prefix("http://")
            .or_else(|| origin.strip_prefix("https://"));
        name == Some(host)
    };
    if !origins.all(own) {
        return Err(foreign());
    }
    // Browsers say so themselves. A link that leads to a page may come from anywhere.
    let site = headers.get("sec-fetch-site").map(HeaderValue::as_bytes);
    let elsewhere = matches!(site, Some(b"cross-site" | b"same-site"));
    if elsewhere && uri.path().starts_with("/api/") {
        return Err(foreign());
    }
    Ok(())
}

/// Tokens of a request: of its cookie, or as a bearer.
fn given_tokens(headers: &HeaderMap) -> impl Iterator<Item = &str> {
    let texts = |name| {
        let values = headers.get_all(name).iter();
        values.filter_map(|value| value.to_str().ok())
    };
    let cookies = texts(header::COOKIE)
        .flat_map(|cookies| cookies.split(';'))
        .filter_map(|cookie| cookie.trim().strip_prefix(COOKIE)?.strip_prefix('='));
    let bearers = texts(header::AUTHORIZATION).filter_map(|value| value.strip_prefix("Bearer "));
    cookies.chain(bearers)
}

/// Compares in a time that does not events how much of the token is right.
fn same(given: &str, token: &str) -> bool {
    let (given, token) = (given.as_bytes(), token.as_bytes());
    given.len() == token.len() && given.iter().zip(token).fold(0, |sum, (a, b)| sum | (a ^ b)) == 0
}

/// Keeps the token in a cookie and out of the address.
fn remember(token: &str, path: &str) -> Response {
    let mut response = http::respond(StatusCode::SEE_OTHER, "text/plain", "");
    let headers = response.headers_mut();
    let cookie = format!("{COOKIE}={token}; HttpOnly; SameSite=Strict; Path=/");
    // A token has letters, digits, `-` and `_` only, and a path came out of an address.
    if let Ok(cookie) = HeaderValue::from_str(&cookie) {
        headers.insert(header::SET_COOKIE, cookie);
    }
    // Two slashes, of either kind, would lead to another host.
    let path = format!("/{}", path.trim_start_matches(['/', '\\']));
    if let Ok(path) = HeaderValue::from_str(&path) {
        headers.insert(header::LOCATION, path);
    }
    response
}
