//! The server: address, routes and connections.

use std::{
    future, io,
    net::SocketAddr,
    pin::pin,
    sync::{Arc, Mutex, PoisonError, mpsc},
    thread,
    time::Duration,
};

use axum::{
    Extension, Router,
    extract::FromRef,
    middleware,
    routing::{get, post},
};
use hyper::{
    Request,
    body::Incoming,
    server::conn::http1,
    service::{Service, service_fn},
};
use hyper_util::{
    rt::{TokioIo, TokioTimer},
    service::TowerToHyperService,
};
use tokio::{
    net::{TcpListener, TcpStream},
    runtime::{Builder, Runtime},
    time,
};

use crate::{
    Options, ServeError, assets, cases,
    connection::{Line, Patient, Place, Places},
    files,
    host_guard::HostGuard,
    index::Index,
    job::{Stop, Workers},
    limits, materials,
    pages::{self, Validation},
    refinement, request, response, study,
};

/// Delay after a failed accept.
const PAUSE: Duration = Duration::from_millis(50);

/// Server with a bound address and a computed first case.
#[derive(Debug)]
pub struct Server {
    runtime: Runtime,
    listener: TcpListener,
    address: SocketAddr,
    routes: Router,
}

/// State shared by all requests.
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

/// Threads that answer requests; computations have others.
const WORKER_THREADS: usize = 2;

impl Server {
    /// Checks the options, computes the first case and binds the address.
    ///
    /// # Errors
    /// [`ServeError`] when the options are not safe, the case is not valid or the address is taken.
    pub fn bind(options: Options) -> Result<Self, ServeError> {
        options.check()?;
        let index = first_page(&options)?;
        check_threads().map_err(ServeError::Start)?;
        let runtime = Builder::new_multi_thread()
            .worker_threads(WORKER_THREADS)
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
            routes: routes(shared, HostGuard::new(&options)),
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

/// Starts as many threads as the server does at first, one after the other: the runtime panics where the system gives none.
fn check_threads() -> io::Result<()> {
    let (sender, receiver) = mpsc::channel::<()>();
    let receiver = Arc::new(Mutex::new(receiver));
    let mut threads = Vec::new();
    for _ in 0..1 + WORKER_THREADS {
        let receiver = Arc::clone(&receiver);
        let wait = move || {
            let receiver = receiver.lock().unwrap_or_else(PoisonError::into_inner);
            // Until the sender is dropped.
            let _ = receiver.recv();
        };
        threads.push(thread::Builder::new().spawn(wait)?);
    }
    drop(sender);
    for thread in threads {
        let _ = thread.join();
    }
    Ok(())
}

/// Page with the results of its first case.
fn first_page(options: &Options) -> Result<Index, ServeError> {
    let case = options.case.clone().unwrap_or_else(cases::first);
    let scenario = percuss::case::load_str(&case.name, &case.text)?;
    let model = percuss::model::default_model(&scenario)?;
    let read = request::ReadCase {
        text: case.text.clone(),
        scenario,
    };
    let stop = Stop::after(options.bounds.time());
    let first = response::compute(read, &model, None, &stop, None)?;
    Ok(Index::new(&case, &first, &options.bounds))
}

fn routes(shared: Shared, guard: HostGuard) -> Router {
    Router::new()
        .route("/", get(Index::get))
        .route("/assets/{name}", get(assets::get))
        .route("/materials", get(materials::get))
        .route("/materials/{name}", get(pages::material))
        .route("/validation", get(Validation::get))
        .route("/api/answer", post(response::post))
        .route("/api/file", post(files::post))
        .route("/api/refinement", post(refinement::post))
        .route("/api/study/{kind}", post(study::post))
        .route("/api/uncertainty-example", post(study::uncertainty_example))
        .route("/api/calibration-example", post(study::calibration_example))
        .route("/api/validation", post(Validation::post))
        .fallback(assets::fallback)
        .layer(middleware::from_fn_with_state(
            Arc::new(guard),
            HostGuard::watch,
        ))
        .with_state(shared)
}

/// Accepts connections, a limited number at a time.
async fn accept(listener: TcpListener, routes: Router) -> ! {
    let places = Places::new();
    loop {
        let Some(free) = places.free().await else {
            continue;
        };
        let Ok((stream, peer)) = listener.accept().await else {
            time::sleep(PAUSE).await;
            continue;
        };
        // Where the peer has its share, the connection is closed.
        if let Some(place) = places.give(free, peer.ip()) {
            tokio::spawn(serve(stream, place, routes.clone()));
        }
    }
}

/// Serves a connection to its end. A client that does not show the token is given up after a while; the run of one that goes away ends. Who
/// closes only its own half of the connection waits for the response.
async fn serve(stream: TcpStream, place: Place, routes: Router) {
    // Without this option small responses are delayed.
    let _ = stream.set_nodelay(true);
    let Ok((stream, watched)) = twice(stream) else {
        return;
    };
    let (visitor, line) = (place.visitor(), Line::default());
    let service = TowerToHyperService::new(routes.layer(Extension(visitor.clone())));
    let service = service_fn(|request: Request<Incoming>| {
        let computing = line.compute(request.version());
        let response = service.call(request);
        async {
            let _computing = computing;
            response.await
        }
    });
    let stream = Patient::new(stream, limits::PATIENCE, line.clone());
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(limits::ARRIVAL)
        .half_close(true)
        .serve_connection(TokioIo::new(stream), service);
    let introduction = async {
        time::sleep(limits::INTRODUCTION).await;
        if visitor.is_known() {
            future::pending::<()>().await;
        }
    };
    let mut connection = pin!(connection);
    let mut ended = pin!(async {
        tokio::select! {
            () = line.is_left(&watched) => {}
            () = introduction => {}
        }
    });
    // A broken connection needs no action.
    tokio::select! {
        biased;
        _ = &mut connection => return,
        () = &mut ended => return,
        () = place.is_wanted(&line) => {}
    }
    // What is asked for is answered; then it closes.
    connection.as_mut().graceful_shutdown();
    tokio::select! {
        biased;
        _ = connection => {}
        () = ended => {}
    }
}

/// A connection and a second handle of it, to watch it by.
fn twice(stream: TcpStream) -> io::Result<(TcpStream, TcpStream)> {
    let stream = stream.into_std()?;
    let watched = stream.try_clone()?;
    Ok((TcpStream::from_std(stream)?, TcpStream::from_std(watched)?))
}
