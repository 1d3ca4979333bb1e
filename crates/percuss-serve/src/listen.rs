//! The server: its address, its routes and its connections.

use std::{net::SocketAddr, sync::Arc, time::Duration};

use axum::{
    Router,
    extract::FromRef,
    middleware,
    response::IntoResponse,
    routing::{get, post},
};
use hyper::server::conn::http1;
use hyper_util::{
    rt::{TokioIo, TokioTimer},
    service::TowerToHyperService,
};
use tokio::{
    net::TcpListener,
    runtime::{Builder, Runtime},
    sync::Semaphore,
    time,
};

use crate::{
    Options, ServeError, answer, assets, bounds, cases, files,
    gate::Gate,
    index::Index,
    pages::{self, Validation},
    request, study,
    worker::{Stop, Workers},
};

/// Time between two tries to take a connection when the system has none to give.
const PAUSE: Duration = Duration::from_millis(50);

/// A server that has its address and its first answer.
#[derive(Debug)]
pub struct Server {
    runtime: Runtime,
    listener: TcpListener,
    address: SocketAddr,
    routes: Router,
}

/// What requests share.
#[derive(Clone)]
struct Shared {
    workers: Workers,
    index: Arc<Index>,
    validation: Arc<Validation>,
}

impl FromRef<Shared> for Workers {
    fn from_ref(shared: &Shared) -> Self {
        shared.workers.clone()
    }
}

impl FromRef<Shared> for Arc<Index> {
    fn from_ref(shared: &Shared) -> Self {
        Arc::clone(&shared.index)
    }
}

impl FromRef<Shared> for Arc<Validation> {
    fn from_ref(shared: &Shared) -> Self {
        Arc::clone(&shared.validation)
    }
}

impl Server {
    /// Checks the options, computes the first answer and takes the address.
    ///
    /// # Errors
    /// [`ServeError`] when the options are not safe, the case is not valid or the address is taken.
    pub fn bind(options: Options) -> Result<Self, ServeError> {
        options.check()?;
        let index = first_page(&options)?;
        let runtime = Builder::new_multi_thread()
            .worker_threads(2)
            .enable_all()
            .build()
            .map_err(ServeError::Start)?;
        let refused = |source| ServeError::Listen {
            address: options.address,
            source,
        };
        let listener = runtime
            .block_on(TcpListener::bind(options.address))
            .map_err(refused)?;
        let address = listener.local_addr().map_err(refused)?;
        let shared = Shared {
            workers: Workers::new(options.bounds),
            index: Arc::new(index),
            validation: Arc::default(),
        };
        Ok(Self {
            routes: routes(shared, Gate::new(&options)),
            runtime,
            listener,
            address,
        })
    }

    /// The address that it listens on.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Serves until the program ends.
    pub fn run(self) -> ! {
        let Self {
            runtime,
            listener,
            routes,
            ..
        } = self;
        runtime.block_on(accept(listener, routes))
    }
}

/// The page with the answer to its first case.
fn first_page(options: &Options) -> Result<Index, ServeError> {
    let case = options.case.clone().unwrap_or_else(cases::first);
    let scenario = percuss::case::load_str(&case.name, &case.text)?;
    let model = percuss::model::default_model(&scenario)?;
    let read = request::ReadCase {
        text: case.text.clone(),
        scenario,
    };
    let stop = Stop::after(options.bounds.time());
    let answer = answer::answer(read, &model, None, &stop, None)?;
    Ok(Index::new(&case, &answer, &options.bounds))
}

fn routes(shared: Shared, gate: Gate) -> Router {
    Router::new()
        .route("/", get(Index::get))
        .route("/assets/{name}", get(assets::get))
        .route("/materials", get(pages::materials))
        .route("/materials/{name}", get(pages::material))
        .route("/validation", get(Validation::get))
        .route("/api/answer", post(answer::post))
        .route("/api/file", post(files::post))
        .route("/api/study/{kind}", post(study::post))
        .route("/api/uncertainty-example", post(study::uncertainty_example))
        .route("/api/validation", post(Validation::post))
        .fallback(async || assets::missing().into_response())
        .layer(middleware::from_fn_with_state(Arc::new(gate), Gate::watch))
        .with_state(shared)
}

/// Takes connections for ever, a limited number at a time.
async fn accept(listener: TcpListener, routes: Router) -> ! {
    let places = Arc::new(Semaphore::new(bounds::CONNECTIONS));
    loop {
        // The semaphore is never closed.
        let Ok(place) = Arc::clone(&places).acquire_owned().await else {
            continue;
        };
        let Ok((stream, _)) = listener.accept().await else {
            time::sleep(PAUSE).await;
            continue;
        };
        // Without this small answers wait for each other.
        let _ = stream.set_nodelay(true);
        let service = TowerToHyperService::new(routes.clone());
        tokio::spawn(async move {
            let _place = place;
            // A connection that breaks is the client's affair.
            let _ = http1::Builder::new()
                .timer(TokioTimer::new())
                .header_read_timeout(bounds::ARRIVAL)
                .serve_connection(TokioIo::new(stream), service)
                .await;
        });
    }
}
