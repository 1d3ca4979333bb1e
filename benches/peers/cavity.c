/*
 * Runs of percuss's default model from impact to rest: a projectile of slices that widen, a crater floor against the pressure of an
 * expanding cavity, and an elastic cone behind it with a fixed rear face (docs/theory/expanding-cavity.md). The README says what is left out.
 *     cc -O3 -march=native -fopenmp cavity.c -o cavity -lm
 * -DSIDE_BY_SIDE changes the order of the loops for plastic flow.
 * Usage: cavity PROBLEM one|batch cavity THREADS END
 */
#include <math.h>
#include <omp.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define PROGRAM "cavity"
#include "program.h"

/* Elements of a body at most, points of the cavity's curve, samples of a transit of the plate, reflections, numbers of an end. */
enum { MOST = 256, POINTS = 400, TRANSIT = 64, ECHOES = 200, MOST_SAMPLES = 1 << 14, NUMBERS = 4 };

static const double PI = 3.14159265358979323846;
static const double COURANT = 0.8, LARGEST_STRAIN_STEP = 0.02, EROSION_STRAIN = 2.0, REST = 0.01, QUIET = 1e-6;
static const double SHEAR_YIELD = 0.769800358919501; /* 4 / (3 sqrt 3) */

/* A material with a power law. */
typedef struct {
    double density, modulus, poissons_ratio, coefficient, exponent;
    double bulk, shear, yield_strain, wave_speed;
} Metal;

typedef struct {
    int slices, springs;
    long runs;
    double length, diameter, thickness;
    Metal rod, target;
    double *speed; /* of every run */
} Problem;

/* Everything that a run needs: a part of the rod, or of the cone, at the same place of every array. */
typedef struct {
    /* Nodes of the rod. */
    double x[MOST + 1], v[MOST + 1], mobility[MOST + 1];
    /* Slices. Stresses are per area at rest. */
    double length[MOST], radius[MOST], widening[MOST], per_length[MOST], per_radius[MOST];
    double pressure[MOST], difference[MOST], plastic[MOST], plastic_sum[MOST], yield[MOST], slope[MOST];
    double axial_force[MOST], radial_force[MOST];
    /* Shear between a slice and the next one; before the first one and behind the last one its force is 0. */
    double shear[MOST], shear_forces[MOST + 1];
    double stiffest, fastest;
    /* Nodes and springs of the cone. */
    double u[MOST + 1], w[MOST + 1], cone_mass[MOST + 1], cone_mobility[MOST + 1], stiffness[MOST], spring[MOST];
    /* Pressure of the cavity against permanent advance over the radius. */
    int points, next;
    double advance[POINTS + 1], cavity[POINTS + 1];
    /* Displacement of the mouth of the cone in waves that leave, at even times. */
    int samples;
    double spacing, last_time, last_value, share[ECHOES + 1], sample[MOST_SAMPLES];
} Run;

static void read_numbers(FILE *file, int count, double **numbers)
{
    for (int i = 0; i < count; i++)
        if (fscanf(file, "%lf", numbers[i]) != 1)
            fail("the problem ends too early");
}

static void read_metal(FILE *file, Metal *m)
{
    read_numbers(file, 5, (double *[]){&m->density, &m->modulus, &m->poissons_ratio, &m->coefficient, &m->exponent});
    m->bulk = m->modulus / (3.0 * (1.0 - 2.0 * m->poissons_ratio));
    m->shear = m->modulus / (2.0 * (1.0 + m->poissons_ratio));
    m->yield_strain = pow(m->coefficient / m->modulus, 1.0 / (1.0 - m->exponent));
    m->wave_speed = sqrt(m->modulus / m->density);
}

static Problem read_problem(const char *path)
{
    Problem p;
    FILE *file = fopen(path, "r");
    if (!file || fscanf(file, "%d %d %ld", &p.slices, &p.springs, &p.runs) != 3)
        fail("cannot read the problem");
    if (p.slices > MOST || p.springs > MOST)
        fail("too many elements");
    read_numbers(file, 3, (double *[]){&p.length, &p.diameter, &p.thickness});
    read_metal(file, &p.rod);
    read_metal(file, &p.target);
    p.speed = reserve(sizeof(double) * p.runs);
    for (long r = 0; r < p.runs; r++)
        read_numbers(file, 1, (double *[]){&p.speed[r]});
    fclose(file);
    return p;
}

/* Integrates the pressure of an expanding cavity over the strain at its wall. */
static void prepare_cavity(Run *s, const Metal *m)
{
    const double twice_shear = 2.0 / 3.0 * m->modulus;
    const double growth = pow(20.0 / m->yield_strain, 1.0 / POINTS);
    double strain = m->yield_strain, pressure = m->modulus * m->yield_strain / 1.5;
    s->advance[0] = 0.0;
    s->cavity[0] = pressure;
    s->points = 1;
    s->next = 0;
    for (int i = 0; i < POINTS; i++) {
        double middle = strain * sqrt(growth);
        double stress = m->coefficient * pow(middle, m->exponent);
        pressure += stress / expm1(1.5 * middle) * strain * (growth - 1.0);
        strain *= growth;
        double permanent = expm1(1.5 * strain) / 1.5 - pressure / twice_shear;
        if (permanent > s->advance[s->points - 1]) {
            s->advance[s->points] = permanent;
            s->cavity[s->points++] = pressure;
        }
    }
}

static double cavity_pressure(Run *s, double advance)
{
    /* The next place is mostly near. */
    int i = s->next;
    while (i < s->points && s->advance[i] <= advance)
        i++;
    s->next = i;
    if (i == s->points)
        return s->cavity[i - 1];
    double part = (advance - s->advance[i - 1]) / (s->advance[i] - s->advance[i - 1]);
    return s->cavity[i - 1] + (s->cavity[i] - s->cavity[i - 1]) * part;
}

static double elements_to(double first, double growth, double z) { return log1p(growth * z / first) / growth; }

/* Divides the cone under a disc into springs that grow in proportion to the depth; gives its longest stable step. */
static double prepare_cone(Run *s, const Problem *p, double apex)
{
    const Metal *m = &p->target;
    const int count = p->springs;
    const double area = PI / 4 * p->diameter * p->diameter, first = p->length / p->slices;
    double low = 0.0, high = 1.0;
    while (elements_to(first, high, p->thickness) > count)
        high *= 2.0;
    for (int i = 0; i < 100; i++) {
        double middle = 0.5 * (low + high);
        if (elements_to(first, middle, p->thickness) > count)
            low = middle;
        else
            high = middle;
    }
    const double all = elements_to(first, high, p->thickness);
    double from = 0.0, shortest = INFINITY;
    memset(s->cone_mass, 0, sizeof s->cone_mass);
    for (int i = 0; i < count; i++) {
        double to = i + 1 == count ? p->thickness : first * expm1(all * (i + 1) / count * high) / high;
        double a = 1.0 + from / apex, b = 1.0 + to / apex, twelfth = m->density * area * (to - from) / 12.0;
        s->cone_mass[i] += twelfth * (3.0 * a * a + 2.0 * a * b + b * b);
        s->cone_mass[i + 1] += twelfth * (a * a + 2.0 * a * b + 3.0 * b * b);
        s->stiffness[i] = m->modulus * area * a * b / (to - from);
        shortest = fmin(shortest, to - from);
        from = to;
    }
    for (int i = 0; i <= count; i++) {
        s->u[i] = s->w[i] = 0.0;
        s->cone_mobility[i] = 1.0 / s->cone_mass[i];
    }
    memset(s->spring, 0, sizeof s->spring);
    return shortest / m->wave_speed;
}

/* Adds a value to the samples: between two values it is linear. */
static void record(Run *s, double time, double value)
{
    double next;
    while ((next = s->samples * s->spacing) <= time && s->samples < MOST_SAMPLES) {
        double part = (next - s->last_time) / (time - s->last_time);
        s->sample[s->samples++] = s->last_value + (value - s->last_value) * part;
    }
    s->last_time = time;
    s->last_value = value;
}

static double sample_at(const Run *s, long i) { return i < 0 ? 0.0 : s->sample[i < s->samples ? i : s->samples - 1]; }

/* Displacement of the mouth by waves that the rear face and the struck face have sent back: cubics through four samples. */
static double echo(const Run *s, double time)
{
    const double place = time / s->spacing;
    const long before = (long)floor(place);
    const double x = place - before, square = x * x, cube = square * x;
    double sum = 0.0;
    for (int j = 1; j <= ECHOES && before - j * 2 * TRANSIT >= -1; j++) {
        long i = before - j * 2 * TRANSIT;
        double a = sample_at(s, i - 1), b = sample_at(s, i), c = sample_at(s, i + 1), d = sample_at(s, i + 2);
        double value = b * (2.0 * cube - 3.0 * square + 1.0) + c * (3.0 * square - 2.0 * cube)
            + 0.5 * (c - a) * (cube - 2.0 * square + x) + 0.5 * (d - b) * (cube - square);
        sum += s->share[j] * value;
    }
    return 2.0 * sum;
}

/* What a step of Newton's method leaves of the stress beyond the yield surface is small enough. */
static inline bool is_last(double stress, double excess, double step, double slope, double plastic_sum)
{
    return (fabs(excess) <= 1e-4 * stress) & (0.5 * step * step * slope <= 1e-8 * stress * plastic_sum);
}

/* Returns stresses beyond the yield surface to it, by Newton's method from the tangent in the last point. */
#ifdef SIDE_BY_SIDE
/* A step for all slices before the next one: a compiler computes several powers at once. */
static void flow(Run *restrict s, const Metal *m, int count)
{
    const double fall = 3.0 * m->shear;
    double increment[MOST], open[MOST], still_open = 0.0;
    for (int i = 0; i < count; i++) {
        double stress = fabs(s->difference[i]), first = fmin((stress - s->yield[i]) / (fall + s->slope[i]), stress / fall);
        open[i] = stress > s->yield[i] ? 1.0 : 0.0;
        increment[i] = open[i] > 0.0 ? first : 0.0;
        still_open += open[i];
    }
    if (still_open == 0.0)
        return;
    for (int k = 0; k < 100 && still_open > 0.0; k++) {
        still_open = 0.0;
        for (int i = 0; i < count; i++) {
            double stress = fabs(s->difference[i]), sum = s->plastic_sum[i] + increment[i], strain = m->yield_strain + sum;
            double hardened = m->coefficient * pow(strain, m->exponent), slope = m->exponent * hardened / strain;
            double excess = stress - fall * increment[i] - hardened, step = excess / (fall + slope);
            double goes_on = is_last(stress, excess, step, slope, sum) ? 0.0 : open[i];
            s->slope[i] = open[i] > 0.0 ? slope : s->slope[i];
            increment[i] = open[i] > 0.0 ? increment[i] + step : increment[i];
            s->yield[i] = open[i] > 0.0 ? stress - fall * increment[i] : s->yield[i];
            open[i] = goes_on;
            still_open += goes_on;
        }
    }
    for (int i = 0; i < count; i++) {
        double step = copysign(increment[i], s->difference[i]);
        s->plastic[i] += step;
        s->plastic_sum[i] += increment[i];
        s->difference[i] -= fall * step;
    }
}
#else
static void flow(Run *restrict s, const Metal *m, int count)
{
    const double fall = 3.0 * m->shear;
    for (int i = 0; i < count; i++) {
        double stress = fabs(s->difference[i]);
        if (stress <= s->yield[i])
            continue;
        double increment = fmin((stress - s->yield[i]) / (fall + s->slope[i]), stress / fall);
        bool last = false;
        for (int k = 0; k < 100 && !last; k++) {
            double sum = s->plastic_sum[i] + increment, strain = m->yield_strain + sum;
            double hardened = m->coefficient * pow(strain, m->exponent), slope = m->exponent * hardened / strain;
            double excess = stress - fall * increment - hardened, step = excess / (fall + slope);
            last = is_last(stress, excess, step, slope, sum);
            s->slope[i] = slope;
            increment += step;
        }
        s->yield[i] = stress - fall * increment;
        double step = copysign(increment, s->difference[i]);
        s->plastic[i] += step;
        s->plastic_sum[i] += increment;
        s->difference[i] -= fall * step;
    }
}
#endif

/* The largest square of a frequency, times the density, and the largest rate of strain of the slices: they limit the next step. */
static void find_limits(Run *restrict s, const Metal *m, int count)
{
    const double axial = m->bulk + m->shear / 0.75 + m->shear, radial = m->bulk + m->shear / 3.0;
    double stiffest = 0.0, fastest = 0.0;
    for (int i = 0; i < count; i++) {
        double stress = fabs(s->pressure[i] + 2.0 / 3.0 * s->difference[i]), per_length = s->per_length[i], per_radius = s->per_radius[i];
        double stiffness = 4.0 * (axial + stress) * (per_length * per_length) + 8.0 * (radial + stress) * (per_radius * per_radius);
        double along = fabs(s->v[i] - s->v[i + 1]) * per_length, across = fabs(s->widening[i]) * per_radius;
        double rate = along > across ? along : across;
        stiffest = stiffness > stiffest ? stiffness : stiffest;
        fastest = rate > fastest ? rate : fastest;
    }
    s->stiffest = stiffest;
    s->fastest = fastest;
}

/* New lengths and radii, stresses and forces of the slices. */
static void respond(Run *restrict s, const Metal *m, int count, double rest_length, double rest_radius, double time_step)
{
    const double volume = PI * rest_radius * rest_radius * rest_length;
    for (int i = 0; i < count; i++) {
        s->length[i] = s->x[i + 1] - s->x[i];
        s->radius[i] += s->widening[i] * time_step;
        double both = 1.0 / (s->length[i] * s->radius[i]);
        s->per_length[i] = both * s->radius[i];
        s->per_radius[i] = both * s->length[i];
    }
    for (int i = 0; i < count; i++) {
        double axial = log(rest_length * s->per_length[i]), radial = log(rest_radius * s->per_radius[i]);
        s->pressure[i] = m->bulk * (axial + 2.0 * radial);
        s->difference[i] = 2.0 * m->shear * (axial - radial - 1.5 * s->plastic[i]);
    }
    flow(s, m, count);
    for (int i = 0; i < count; i++) {
        double stress = s->pressure[i] + 2.0 / 3.0 * s->difference[i], radial_stress = s->pressure[i] - 1.0 / 3.0 * s->difference[i];
        s->axial_force[i] = stress * volume * s->per_length[i];
        s->radial_force[i] = 2.0 * radial_stress * volume * s->per_radius[i];
    }
    find_limits(s, m, count);
    for (int i = 0; i + 1 < count; i++) {
        double per_length = 1.0 / (0.5 * (s->length[i] + s->length[i + 1]));
        double limit = SHEAR_YIELD * 0.5 * (s->yield[i] + s->yield[i + 1]);
        double stress = s->shear[i] + m->shear * (s->widening[i + 1] - s->widening[i]) * time_step * per_length;
        stress = stress < -limit ? -limit : stress > limit ? limit : stress;
        s->shear[i] = stress;
        s->shear_forces[i + 1] = 0.5 * volume * per_length * stress;
    }
}

/* A run: the depth of the crater [m], the velocity of the projectile at the end [m/s], its time to rest [s] and the number of steps. */
static void advance(Run *restrict s, const Problem *p, double speed, double *end)
{
    const Metal *m = &p->rod, *ground = &p->target;
    const int k = p->springs;
    int n = p->slices;
    const double radius = 0.5 * p->diameter, area = PI * radius * radius, spacing = p->length / n;
    const double mass = m->density * area * spacing, added = 4.0 / 3.0 * ground->density * radius * radius * radius;
    const double apex = PI / 2 * (1.0 - ground->poissons_ratio * ground->poissons_ratio) * radius;
    const double mouth_area = 1.0 + p->thickness / apex, far_area = area * mouth_area * mouth_area;
    const double impedance = sqrt(ground->modulus * ground->density) * far_area;
    const double far_stiffness = ground->modulus * far_area / (apex + p->thickness);
    const double window = 2.0 * fmax(p->length, p->diameter) / m->wave_speed;
    const double cone_step = prepare_cone(s, p, apex);
    prepare_cavity(s, ground);
    for (int i = 0; i <= n; i++) {
        s->x[i] = -spacing * (n - i);
        s->v[i] = speed;
        s->mobility[i] = 1.0 / (i == 0 || i == n ? 0.5 * mass : mass);
        s->shear_forces[i] = 0.0;
    }
    for (int i = 0; i < n; i++) {
        s->length[i] = spacing;
        s->radius[i] = radius;
        s->per_length[i] = 1.0 / spacing;
        s->per_radius[i] = 1.0 / radius;
        s->widening[i] = s->pressure[i] = s->difference[i] = s->plastic[i] = s->plastic_sum[i] = 0.0;
        s->axial_force[i] = s->radial_force[i] = s->shear[i] = 0.0;
        s->yield[i] = m->modulus * m->yield_strain;
        s->slope[i] = m->exponent * m->modulus;
    }
    s->spacing = p->thickness / (ground->wave_speed * TRANSIT);
    s->samples = 1;
    s->sample[0] = s->last_time = s->last_value = 0.0;
    for (int j = 1; j <= ECHOES; j++)
        s->share[j] = (j % 2 ? -1.0 : 1.0) / (1.0 + 2.0 * j * p->thickness / apex);

    const double tip_mass = 0.5 * mass, mouth_mass = s->cone_mass[0];
    const double eroded_length = spacing * exp(-EROSION_STRAIN);
    double lost_length = 0.0, time = 0.0, before = 0.0, depth = 0.0, floor_speed = 0.0, echo_place = 0.0, echo_speed = 0.0;
    double at_rest = -1.0, window_start = 0.0, window_depth = 0.0, momentum;
    bool closed = true, touched = false;
    long steps = 0;
    find_limits(s, m, n);
    for (;;) {
        /* Changes of the time step cost energy: small ones are not made. */
        double stable = 2.0 / sqrt(s->stiffest / m->density);
        if (stable * s->fastest > LARGEST_STRAIN_STEP)
            stable = LARGEST_STRAIN_STEP / s->fastest;
        const double allowed = COURANT * fmin(stable, cone_step);
        const double step = before == 0.0 || allowed < before ? 0.98 * allowed : allowed > 1.1 * before ? 1.05 * before : before;
        const double kick = 0.5 * (before + step), ratio = kick / (0.5 * mass);

        s->v[0] -= s->axial_force[0] * kick * s->mobility[0];
        for (int i = 1; i < n; i++)
            s->v[i] += (s->axial_force[i - 1] - s->axial_force[i]) * kick * s->mobility[i];
        for (int i = 0; i < n; i++)
            s->widening[i] += (s->radial_force[i] - s->shear_forces[i] + s->shear_forces[i + 1]) * ratio;
        for (int i = 1; i < k; i++)
            s->w[i] += (s->spring[i - 1] - s->spring[i]) * kick * s->cone_mobility[i];
        /* The last node takes up waves as the cone beyond would. */
        double inertia = s->cone_mass[k] / kick;
        s->w[k] = ((inertia - 0.5 * impedance) * s->w[k] + s->spring[k - 1] - far_stiffness * s->u[k]) / (inertia + 0.5 * impedance);

        /* A tip on the floor comes no closer. */
        double tip = s->v[n], mouth = s->w[0];
        if (closed) {
            double floor_mobility = floor_speed > 0.0 ? 1.0 / added : 0.0;
            double impulse = (tip - mouth - echo_speed - floor_speed) / (1.0 / tip_mass + 1.0 / mouth_mass + floor_mobility);
            tip -= impulse / tip_mass;
            mouth += impulse / mouth_mass;
            floor_speed = fmax(floor_speed + impulse * floor_mobility, 0.0);
        }
        const double echo_before = echo_speed;
        echo_speed = (echo(s, time + step) - echo_place) / step;
        const double echo_pull = (echo_speed - echo_before) / kick;

        /* Tip, floor and mouth. */
        const double push = s->axial_force[n - 1], pull = -s->spring[0];
        const double pressure = cavity_pressure(s, depth / radius) + 0.5 * ground->density * floor_speed * floor_speed;
        double force = -1.0, gain = 0.0;
        if (closed) {
            const double tip_area = PI * s->radius[n - 1] * s->radius[n - 1], closing = fmax(s->v[0] - tip, 0.0);
            const double pressing = fmin(fabs(s->difference[n - 1]), s->cavity[s->points - 1]);
            const double spread = fmax(tip_area - area, 0.0) * pressing - 0.5 * m->density * area * closing * closing;
            const double resisting = area * pressure + fmax(spread, 0.0);
            const double together = (push + pull + mouth_mass * echo_pull) / (tip_mass + mouth_mass);
            force = push - tip_mass * together;
            if (floor_speed != 0.0 || force > resisting) {
                gain = (push - resisting) / tip_mass - (resisting + pull) / mouth_mass - echo_pull;
                gain /= 1.0 + added * (1.0 / tip_mass + 1.0 / mouth_mass);
                force = resisting + added * gain;
            }
        }
        if (force < 0.0) {
            closed = false;
            floor_speed = fmax(floor_speed - area * pressure * kick / added, 0.0);
            tip += push * kick / tip_mass;
            mouth += pull * kick / mouth_mass;
        } else if (floor_speed + gain * kick >= 0.0) {
            floor_speed += gain * kick;
            tip += (push - force) * kick / tip_mass;
            mouth += (pull + force) * kick / mouth_mass;
        } else {
            /* The floor comes to rest on the way: tip and mouth go on together. */
            double sum = tip_mass * tip + mouth_mass * mouth + (push + pull) * kick;
            tip = (sum + mouth_mass * echo_speed) / (tip_mass + mouth_mass);
            mouth = tip - echo_speed;
            floor_speed = 0.0;
        }
        if (!closed) {
            /* A tip that would pass the floor touches it at the end of the step. */
            double gap = s->u[0] + echo_place + depth - (s->x[n] + lost_length), approach = tip - mouth - echo_speed - floor_speed;
            if (gap <= approach * step) {
                closed = true;
                double floor_mobility = floor_speed > 0.0 ? 1.0 / added : 0.0;
                double impulse = (approach - fmax(gap, 0.0) / step) / (1.0 / tip_mass + 1.0 / mouth_mass + floor_mobility);
                tip -= impulse / tip_mass;
                mouth += impulse / mouth_mass;
                floor_speed = fmax(floor_speed + impulse * floor_mobility, 0.0);
            }
        }
        s->v[n] = tip;
        s->w[0] = mouth;

        for (int i = 0; i <= k; i++)
            s->u[i] += s->w[i] * step;
        for (int i = 0; i < k; i++)
            s->spring[i] = s->stiffness[i] * (s->u[i] - s->u[i + 1]);
        for (int i = 0; i <= n; i++)
            s->x[i] += s->v[i] * step;
        respond(s, m, n, spacing, radius, step);
        depth += floor_speed * step;
        time += step;
        before = step;
        steps++;
        echo_place += echo_speed * step;
        record(s, time, s->u[0]);
        if (s->samples == MOST_SAMPLES)
            fail("a run does not end");
        if (s->length[n - 1] <= eroded_length) {
            do {
                lost_length += s->length[--n];
                if (n == 0)
                    fail("a whole projectile eroded: that is not in this program");
            } while (s->length[n - 1] <= eroded_length);
            s->mobility[n] = 1.0 / tip_mass;
            s->shear_forces[n] = 0.0;
            find_limits(s, m, n);
        }

        touched |= closed;
        const bool over = time >= window_start + window;
        if (at_rest >= 0.0 && !over)
            continue;
        momentum = tip_mass * (s->v[0] + s->v[n]);
        for (int i = 1; i < n; i++)
            momentum += mass * s->v[i];
        if (at_rest < 0.0 && momentum <= 0.0)
            at_rest = time;
        if (!over)
            continue;
        /* The run is over when a round trip of a wave in the projectile changes nothing any more. */
        bool sinks = depth > window_depth * (1.0 + QUIET) || floor_speed > 0.0;
        bool still = fabs(momentum / (mass * n)) <= REST * speed;
        bool ends = !sinks && at_rest >= 0.0 && (still || (!touched && momentum <= 0.0));
        window_start = time;
        window_depth = depth;
        touched = false;
        if (ends)
            break;
    }
    end[0] = depth;
    end[1] = momentum / (mass * n);
    end[2] = at_rest;
    end[3] = steps;
}

int main(int count, char **words)
{
    if (count != 6)
        fail("usage: cavity PROBLEM one|batch cavity THREADS END");
    const Problem p = read_problem(words[1]);
    omp_set_num_threads(strcmp(words[2], "batch") ? 1 : atoi(words[4]));
    double *end = reserve(sizeof(double) * NUMBERS * p.runs);
    /* Threads start before the clock does. */
#pragma omp parallel
    {
    }
    double start = omp_get_wtime(), start_of_work = processor_time();
#pragma omp parallel
    {
        Run *run = reserve(sizeof(Run));
#pragma omp for schedule(dynamic)
        for (long r = 0; r < p.runs; r++)
            advance(run, &p, p.speed[r], end + NUMBERS * r);
        free(run);
    }
    double clock = omp_get_wtime() - start, work = processor_time() - start_of_work, steps = 0.0;
    for (long r = 0; r < p.runs; r++)
        steps += end[NUMBERS * r + 3];
    printf("%.9f %.9f %.0f\n", clock, work, steps * (p.slices + p.springs));
    FILE *file = fopen(words[5], "wb");
    size_t numbers = NUMBERS * p.runs;
    if (!file || fwrite(end, sizeof(double), numbers, file) != numbers || fclose(file))
        fail("cannot write where the runs end");
    return 0;
}
