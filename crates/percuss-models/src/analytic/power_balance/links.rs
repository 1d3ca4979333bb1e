//! One time step of bodies in a row that push each other through rigid-plastic links.

/// Bodies at most: projectile, plug and dish.
pub(super) const BODIES: usize = 3;

/// A body in a row, and the link to the next one or, of the last, to the elastic plate around it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Body {
    /// Mass [kg].
    pub mass: f64,
    /// Velocity before the step [m/s].
    pub velocity: f64,
    /// Impulse at which the link yields when this body is faster than the next [N s].
    pub largest: f64,
    /// Impulse when it is slower: 0 for bodies that part, else the negative of the largest [N s].
    pub least: f64,
}

/// Bodies in a row, and what the last link holds on to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row<'a> {
    pub bodies: &'a [Body],
    /// Velocity of the plate over the impulse that it takes in the step [1/kg]; 0 for a plate at rest.
    pub mobility: f64,
}

/// Velocities after a step [m/s] and impulses of the links [N s].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Step {
    pub velocities: [f64; BODIES],
    pub impulses: [f64; BODIES],
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Link {
    Yields,
    Holds,
    Parts,
}

/// Ways of a link, the most frequent first.
const STATES: [Link; 3] = [Link::Holds, Link::Yields, Link::Parts];
/// Ways that are tried first, then all: few bodies part.
const TRIED: [usize; 2] = [2, 3];
/// Differences of velocity and impulse that count as none, as a part of the largest.
const NOTHING: f64 = 1e-12;

/// The step that minimises `Σ ½m(v′ − v)² + Σ J(v′ᵢ − v′ᵢ₊₁) + v′ₙ²/2c`: Newton's law, with impulses that yielding links bound, and a
/// plate of mobility c whose velocity is `v′ₙ`.
///
/// The function is convex, so of the few ways in which links can yield or hold exactly one fits.
pub(super) fn step(row: Row<'_>) -> Step {
    let bodies = row.bodies;
    let count = bodies.len();
    let scale = bodies
        .iter()
        .fold(0.0_f64, |most, body| most.max(body.velocity.abs()));
    let mut best = (f64::INFINITY, Step::default());
    let choices = TRIED
        .into_iter()
        .flat_map(|ways| (0..ways.pow(count as u32)).map(move |choice| (ways, choice)));
    for (ways, choice) in choices {
        let mut links = [Link::Yields; BODIES];
        let mut rest = choice;
        for link in links.iter_mut().take(count) {
            *link = STATES[rest % ways];
            rest /= ways;
        }
        let known = |i: usize| match links[i] {
            Link::Yields => bodies[i].largest,
            Link::Holds => 0.0,
            Link::Parts => bodies[i].least,
        };
        if (0..count).any(|i| !known(i).is_finite()) {
            continue;
        }
        let tried = velocities(row, &links, known);
        let excess = misfit(row, &links, &tried, scale);
        if excess <= NOTHING {
            return tried;
        }
        if excess < best.0 {
            best = (excess, tried);
        }
    }
    best.1
}

/// Velocities of bodies whose links yield or hold in a given way; held ones move as one.
fn velocities(row: Row<'_>, links: &[Link; BODIES], known: impl Fn(usize) -> f64) -> Step {
    let bodies = row.bodies;
    let mut step = Step::default();
    let count = bodies.len();
    let mut first = 0;
    while first < count {
        let mut last = first;
        while last + 1 < count && links[last] == Link::Holds {
            last += 1;
        }
        let pushed = if first == 0 { 0.0 } else { known(first - 1) };
        let (mut mass, mut momentum) = (0.0, pushed - known(last));
        for body in &bodies[first..=last] {
            mass += body.mass;
            momentum += body.mass * body.velocity;
        }
        let fixed = last + 1 == count && links[last] == Link::Holds;
        let velocity = match fixed {
            true => momentum * row.mobility / (1.0 + mass * row.mobility),
            false => momentum / mass,
        };
        for common in &mut step.velocities[first..=last] {
            *common = velocity;
        }
        first = last + 1;
    }
    let mut impulse = 0.0;
    for (i, body) in bodies.iter().enumerate() {
        impulse += body.mass * (body.velocity - step.velocities[i]);
        step.impulses[i] = impulse;
    }
    step
}

/// How far a step is from what its links allow, as a part of the velocities and impulses in play.
fn misfit(row: Row<'_>, links: &[Link; BODIES], step: &Step, scale: f64) -> f64 {
    let bodies = row.bodies;
    let total: f64 = bodies.iter().map(|body| body.mass).sum();
    (0..bodies.len()).fold(0.0_f64, |worst, i| {
        let relative = step.velocities[i] - row.next(step, i);
        let excess = match links[i] {
            Link::Yields => -relative / scale,
            Link::Parts => relative / scale,
            Link::Holds => {
                let impulse = step.impulses[i];
                let over = (impulse - bodies[i].largest).max(bodies[i].least - impulse);
                over / (total * scale)
            }
        };
        worst.max(if excess.is_nan() { 0.0 } else { excess })
    })
}

/// The function that [`step`] makes least [J], up to a constant.
pub(super) fn potential(row: Row<'_>, step: &Step) -> f64 {
    let bodies = row.bodies;
    let last = step.impulses[bodies.len() - 1];
    let links: f64 = (0..bodies.len())
        .map(|i| {
            let relative = step.velocities[i] - row.next(step, i);
            let change = step.velocities[i] - bodies[i].velocity;
            let link = match relative {
                faster if faster > 0.0 && bodies[i].largest.is_finite() => {
                    bodies[i].largest * faster
                }
                slower if slower < 0.0 => bodies[i].least * slower,
                _ => 0.0,
            };
            0.5 * bodies[i].mass * change * change + link
        })
        .sum();
    links + 0.5 * row.mobility * last * last
}

impl Row<'_> {
    /// Velocity of what a body's link leads to.
    fn next(&self, step: &Step, i: usize) -> f64 {
        match i + 1 < self.bodies.len() {
            true => step.velocities[i + 1],
            false => self.mobility * step.impulses[i],
        }
    }
}
