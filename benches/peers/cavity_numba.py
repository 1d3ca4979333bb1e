"""Runs of percuss's default model with numba, as one writes them in Python: loops over slices, springs and steps, and `prange` over the runs."""

import math
import sys

import numba
import numpy as np
import problem

POINTS, TRANSIT, ECHOES, MOST_SAMPLES = 400, 64, 200, 1 << 14
COURANT, LARGEST_STRAIN_STEP, EROSION_STRAIN, REST, QUIET = 0.8, 0.02, 2.0, 0.01, 1e-6
SHEAR_YIELD = 4 / (3 * math.sqrt(3))


@numba.njit(cache=True)
def moduli(metal):
    """Bulk and shear modulus, strain at first yield, wave speed."""
    density, modulus, poissons_ratio, coefficient, exponent = metal
    bulk, shear = modulus / (3 * (1 - 2 * poissons_ratio)), modulus / (2 * (1 + poissons_ratio))
    return bulk, shear, (coefficient / modulus) ** (1 / (1 - exponent)), math.sqrt(modulus / density)


@numba.njit(cache=True)
def cavity_curve(metal, yield_strain):
    """Pressure of an expanding cavity against permanent advance over the radius: an integral over the strain at its wall."""
    _, modulus, _, coefficient, exponent = metal
    twice_shear = 2 / 3 * modulus
    growth = (20 / yield_strain) ** (1 / POINTS)
    advances, pressures = np.zeros(POINTS + 1), np.zeros(POINTS + 1)
    strain, pressure, count = yield_strain, modulus * yield_strain / 1.5, 1
    pressures[0] = pressure
    for _ in range(POINTS):
        middle = strain * math.sqrt(growth)
        pressure += coefficient * middle**exponent / math.expm1(1.5 * middle) * strain * (growth - 1)
        strain *= growth
        permanent = math.expm1(1.5 * strain) / 1.5 - pressure / twice_shear
        if permanent > advances[count - 1]:
            advances[count], pressures[count] = permanent, pressure
            count += 1
    return advances[:count], pressures[:count]


@numba.njit(cache=True)
def elements_to(first, growth, z):
    return math.log1p(growth * z / first) / growth


@numba.njit(cache=True)
def cone_springs(metal, wave_speed, area, apex, thickness, first, count):
    """Masses and stiffnesses of a cone whose springs grow in proportion to the depth, and its longest stable step."""
    density, modulus = metal[0], metal[1]
    low, high = 0.0, 1.0
    while elements_to(first, high, thickness) > count:
        high *= 2
    for _ in range(100):
        middle = 0.5 * (low + high)
        if elements_to(first, middle, thickness) > count:
            low = middle
        else:
            high = middle
    total = elements_to(first, high, thickness)
    mass, stiffness = np.zeros(count + 1), np.zeros(count)
    start, shortest = 0.0, thickness
    for i in range(count):
        end = thickness if i + 1 == count else first * math.expm1(total * (i + 1) / count * high) / high
        a, b, twelfth = 1 + start / apex, 1 + end / apex, density * area * (end - start) / 12
        mass[i] += twelfth * (3 * a * a + 2 * a * b + b * b)
        mass[i + 1] += twelfth * (a * a + 2 * a * b + 3 * b * b)
        stiffness[i] = modulus * area * a * b / (end - start)
        shortest = min(shortest, end - start)
        start = end
    return mass, stiffness, shortest / wave_speed


@numba.njit(cache=True)
def sample_at(samples, count, i):
    return 0.0 if i < 0 else samples[min(i, count - 1)]


@numba.njit(cache=True)
def echo(samples, count, spacing, share, time):
    """Displacement of the mouth by waves that the rear face and the struck face have sent back: cubics through four samples."""
    place = time / spacing
    before = math.floor(place)
    x = place - before
    square, cube = x * x, x * x * x
    total = 0.0
    for j in range(1, ECHOES + 1):
        i = before - j * 2 * TRANSIT
        if i < -1:
            break
        a, b = sample_at(samples, count, i - 1), sample_at(samples, count, i)
        c, d = sample_at(samples, count, i + 1), sample_at(samples, count, i + 2)
        value = b * (2 * cube - 3 * square + 1) + c * (3 * square - 2 * cube)
        value += 0.5 * (c - a) * (cube - 2 * square + x) + 0.5 * (d - b) * (cube - square)
        total += share[j] * value
    return 2 * total


@numba.njit(cache=True)
def flow(coefficient, exponent, first_strain, stress, fall, strain_before, strength, slope):
    """Plastic strain that returns a stress beyond the yield surface to it: Newton's method from the tangent in the last point."""
    increment = min((stress - strength) / (fall + slope), stress / fall)
    for _ in range(100):
        strain = first_strain + strain_before + increment
        hardened = coefficient * strain**exponent
        excess = stress - fall * increment - hardened
        slope = exponent * hardened / strain
        step = excess / (fall + slope)
        last = abs(excess) <= 1e-4 * stress and 0.5 * step * step * slope <= 1e-8 * stress * (strain_before + increment)
        increment += step
        if last:
            break
    return increment, slope


@numba.njit(cache=True)
def find_limits(n, axial, radial, per_length, per_radius, pressure, difference, v, widening):
    """The largest square of a frequency, times the density, and the largest rate of strain of the slices: they limit the next step."""
    stiffest = fastest = 0.0
    for i in range(n):
        stress = abs(pressure[i] + 2 / 3 * difference[i])
        stiffness = 4 * (axial + stress) * per_length[i] ** 2 + 8 * (radial + stress) * per_radius[i] ** 2
        stiffest = max(stiffest, stiffness)
        fastest = max(fastest, abs(v[i] - v[i + 1]) * per_length[i], abs(widening[i]) * per_radius[i])
    return stiffest, fastest


@numba.njit(cache=True)
def run(slices, springs, rod_length, diameter, thickness, rod, target, speed):
    """Depth of the crater [m], velocity of the projectile at the end [m/s], its time to rest [s] and the number of steps."""
    n, k = slices, springs
    density, _, _, coefficient, exponent = rod
    bulk, shear_modulus, yield_strain, wave_speed = moduli(rod)
    target_density, target_modulus, poissons_ratio = target[0], target[1], target[2]
    _, _, target_yield_strain, target_speed = moduli(target)
    spacing, rest_radius = rod_length / n, 0.5 * diameter
    area = math.pi * rest_radius**2
    volume = area * spacing
    mass, added = density * volume, 4 / 3 * target_density * rest_radius**3
    apex = math.pi / 2 * (1 - poissons_ratio**2) * rest_radius
    far_area = area * (1 + thickness / apex) ** 2
    impedance = math.sqrt(target_modulus * target_density) * far_area
    far_stiffness = target_modulus * far_area / (apex + thickness)
    window = 2 * max(rod_length, diameter) / wave_speed
    axial_stiffness, radial_stiffness = bulk + shear_modulus / 0.75 + shear_modulus, bulk + shear_modulus / 3
    fall = 3 * shear_modulus
    cone_mass, stiffness, cone_step = cone_springs(target, target_speed, area, apex, thickness, spacing, k)
    advances, pressures = cavity_curve(target, target_yield_strain)
    place = 0

    x, v = np.empty(n + 1), np.full(n + 1, speed)
    mobility = np.full(n + 1, 1 / mass)
    mobility[0] = mobility[n] = 2 / mass
    for i in range(n + 1):
        x[i] = -spacing * (n - i)
    length, radius = np.full(n, spacing), np.full(n, rest_radius)
    per_length, per_radius = 1 / length, 1 / radius
    widening, pressure, difference = np.zeros(n), np.zeros(n), np.zeros(n)
    plastic, plastic_sum = np.zeros(n), np.zeros(n)
    strength, slope = np.full(n, rod[1] * yield_strain), np.full(n, exponent * rod[1])
    axial_force, radial_force = np.zeros(n), np.zeros(n)
    shear, shear_force = np.zeros(n), np.zeros(n + 1)
    u, w, spring = np.zeros(k + 1), np.zeros(k + 1), np.zeros(k)
    cone_mobility = 1 / cone_mass

    sample_spacing = thickness / (target_speed * TRANSIT)
    samples, share = np.zeros(MOST_SAMPLES), np.zeros(ECHOES + 1)
    count, last_time, last_value = 1, 0.0, 0.0
    for j in range(1, ECHOES + 1):
        share[j] = (-1.0 if j % 2 else 1.0) / (1 + 2 * j * thickness / apex)

    tip_mass, mouth_mass = 0.5 * mass, cone_mass[0]
    eroded_length, lost_length = spacing * math.exp(-EROSION_STRAIN), 0.0
    time = before = depth = floor_speed = echo_place = echo_speed = 0.0
    at_rest, window_start, window_depth = -1.0, 0.0, 0.0
    closed, touched, steps = True, False, 0
    stiffest, fastest = find_limits(
        n, axial_stiffness, radial_stiffness, per_length, per_radius, pressure, difference, v, widening
    )
    while True:
        # Changes of the time step cost energy: small ones are not made.
        stable = 2 / math.sqrt(stiffest / density)
        if stable * fastest > LARGEST_STRAIN_STEP:
            stable = LARGEST_STRAIN_STEP / fastest
        allowed = COURANT * min(stable, cone_step)
        if before == 0 or allowed < before:
            step = 0.98 * allowed
        else:
            step = 1.05 * before if allowed > 1.1 * before else before
        kick = 0.5 * (before + step)
        ratio = kick / (0.5 * mass)

        v[0] -= axial_force[0] * kick * mobility[0]
        for i in range(1, n):
            v[i] += (axial_force[i - 1] - axial_force[i]) * kick * mobility[i]
        for i in range(n):
            widening[i] += (radial_force[i] - shear_force[i] + shear_force[i + 1]) * ratio
        for i in range(1, k):
            w[i] += (spring[i - 1] - spring[i]) * kick * cone_mobility[i]
        # The last node takes up waves as the cone beyond would.
        inertia = cone_mass[k] / kick
        w[k] = ((inertia - 0.5 * impedance) * w[k] + spring[k - 1] - far_stiffness * u[k]) / (inertia + 0.5 * impedance)

        # A tip on the floor comes no closer.
        tip, mouth = v[n], w[0]
        if closed:
            floor_mobility = 1 / added if floor_speed > 0 else 0.0
            impulse = (tip - mouth - echo_speed - floor_speed) / (1 / tip_mass + 1 / mouth_mass + floor_mobility)
            tip -= impulse / tip_mass
            mouth += impulse / mouth_mass
            floor_speed = max(floor_speed + impulse * floor_mobility, 0.0)
        echo_before = echo_speed
        echo_speed = (echo(samples, count, sample_spacing, share, time + step) - echo_place) / step
        echo_pull = (echo_speed - echo_before) / kick

        # Tip, floor and mouth.
        push, pull = axial_force[n - 1], -spring[0]
        advance = depth / rest_radius
        while place < len(advances) and advances[place] <= advance:
            place += 1
        cavity = pressures[place - 1]
        if place < len(advances):
            part = (advance - advances[place - 1]) / (advances[place] - advances[place - 1])
            cavity += (pressures[place] - pressures[place - 1]) * part
        floor_pressure = cavity + 0.5 * target_density * floor_speed**2
        force, gain = -1.0, 0.0
        if closed:
            closing = max(v[0] - tip, 0.0)
            pressing = min(abs(difference[n - 1]), pressures[-1])
            spread = max(math.pi * radius[n - 1] ** 2 - area, 0.0) * pressing - 0.5 * density * area * closing**2
            resisting = area * floor_pressure + max(spread, 0.0)
            together = (push + pull + mouth_mass * echo_pull) / (tip_mass + mouth_mass)
            force = push - tip_mass * together
            if floor_speed != 0 or force > resisting:
                gain = (push - resisting) / tip_mass - (resisting + pull) / mouth_mass - echo_pull
                gain /= 1 + added * (1 / tip_mass + 1 / mouth_mass)
                force = resisting + added * gain
        if force < 0:
            closed = False
            floor_speed = max(floor_speed - area * floor_pressure * kick / added, 0.0)
            tip += push * kick / tip_mass
            mouth += pull * kick / mouth_mass
        elif floor_speed + gain * kick >= 0:
            floor_speed += gain * kick
            tip += (push - force) * kick / tip_mass
            mouth += (pull + force) * kick / mouth_mass
        else:
            # The floor comes to rest on the way: tip and mouth go on together.
            total = tip_mass * tip + mouth_mass * mouth + (push + pull) * kick
            tip = (total + mouth_mass * echo_speed) / (tip_mass + mouth_mass)
            mouth = tip - echo_speed
            floor_speed = 0.0
        if not closed:
            # A tip that would pass the floor touches it at the end of the step.
            gap = u[0] + echo_place + depth - (x[n] + lost_length)
            approach = tip - mouth - echo_speed - floor_speed
            if gap <= approach * step:
                closed = True
                floor_mobility = 1 / added if floor_speed > 0 else 0.0
                impulse = (approach - max(gap, 0.0) / step) / (1 / tip_mass + 1 / mouth_mass + floor_mobility)
                tip -= impulse / tip_mass
                mouth += impulse / mouth_mass
                floor_speed = max(floor_speed + impulse * floor_mobility, 0.0)
        v[n], w[0] = tip, mouth

        for i in range(k + 1):
            u[i] += w[i] * step
        for i in range(k):
            spring[i] = stiffness[i] * (u[i] - u[i + 1])
        for i in range(n + 1):
            x[i] += v[i] * step
        for i in range(n):
            length[i] = x[i + 1] - x[i]
            radius[i] += widening[i] * step
            both = 1 / (length[i] * radius[i])
            per_length[i], per_radius[i] = both * radius[i], both * length[i]
        for i in range(n):
            axial, radial = math.log(spacing * per_length[i]), math.log(rest_radius * per_radius[i])
            pressure[i] = bulk * (axial + 2 * radial)
            trial = 2 * shear_modulus * (axial - radial - 1.5 * plastic[i])
            if abs(trial) > strength[i]:
                increment, slope[i] = flow(
                    coefficient, exponent, yield_strain, abs(trial), fall, plastic_sum[i], strength[i], slope[i]
                )
                strength[i] = abs(trial) - fall * increment
                plastic[i] += math.copysign(increment, trial)
                plastic_sum[i] += increment
                trial -= fall * math.copysign(increment, trial)
            difference[i] = trial
        for i in range(n):
            axial_force[i] = (pressure[i] + 2 / 3 * difference[i]) * volume * per_length[i]
            radial_force[i] = 2 * (pressure[i] - 1 / 3 * difference[i]) * volume * per_radius[i]
        for i in range(n - 1):
            per_mean = 1 / (0.5 * (length[i] + length[i + 1]))
            limit = SHEAR_YIELD * 0.5 * (strength[i] + strength[i + 1])
            stress = shear[i] + shear_modulus * (widening[i + 1] - widening[i]) * step * per_mean
            shear[i] = min(max(stress, -limit), limit)
            shear_force[i + 1] = 0.5 * volume * per_mean * shear[i]
        depth += floor_speed * step
        time += step
        before = step
        steps += 1

        # Samples of what leaves: between two values it is linear.
        echo_place += echo_speed * step
        while count * sample_spacing <= time:
            if count == MOST_SAMPLES:
                return math.nan, math.nan, math.nan, steps
            part = (count * sample_spacing - last_time) / (time - last_time)
            samples[count] = last_value + (u[0] - last_value) * part
            count += 1
        last_time, last_value = time, u[0]
        if length[n - 1] <= eroded_length:
            while length[n - 1] <= eroded_length:
                n -= 1
                lost_length += length[n]
                if n == 0:
                    return math.nan, math.nan, math.nan, steps
            mobility[n] = 1 / tip_mass
            shear_force[n] = 0.0
        stiffest, fastest = find_limits(
            n, axial_stiffness, radial_stiffness, per_length, per_radius, pressure, difference, v, widening
        )

        touched |= closed
        over = time >= window_start + window
        if at_rest >= 0 and not over:
            continue
        momentum = tip_mass * (v[0] + v[n])
        for i in range(1, n):
            momentum += mass * v[i]
        if at_rest < 0 and momentum <= 0:
            at_rest = time
        if not over:
            continue
        # The run is over when a round trip of a wave in the projectile changes nothing any more.
        mean = momentum / (mass * n)
        sinks = depth > window_depth * (1 + QUIET) or floor_speed > 0
        if not sinks and at_rest >= 0 and (abs(mean) <= REST * speed or (not touched and mean <= 0)):
            return depth, mean, at_rest, steps
        window_start, window_depth, touched = time, depth, False


@numba.njit(cache=True)
def one(ends, slices, springs, length, diameter, thickness, rod, target, speeds):
    for r in range(len(speeds)):
        ends[r, 0], ends[r, 1], ends[r, 2], ends[r, 3] = run(slices, springs, length, diameter, thickness, rod, target, speeds[r])


@numba.njit(parallel=True, cache=True)
def batch(ends, slices, springs, length, diameter, thickness, rod, target, speeds):
    for r in numba.prange(len(speeds)):
        ends[r, 0], ends[r, 1], ends[r, 2], ends[r, 3] = run(slices, springs, length, diameter, thickness, rod, target, speeds[r])


def advance(path: str, together: str, law: str, threads: int):
    with open(path, encoding="utf-8") as file:
        words = file.read().split()
    slices, springs, _ = (int(word) for word in words[:3])
    numbers = [float(word) for word in words[3:]]
    rod, target, speeds = tuple(numbers[3:8]), tuple(numbers[8:13]), np.array(numbers[13:])
    numba.set_num_threads(threads)
    function = batch if together == "batch" else one

    def work(speeds: np.ndarray = speeds) -> np.ndarray:
        ends = np.zeros((len(speeds), 4))
        function(ends, slices, springs, *numbers[:3], rod, target, speeds)
        return ends

    work(speeds[:1])  # compiles
    return work, slices + springs


if __name__ == "__main__":
    work, elements = advance(sys.argv[1], *sys.argv[2:4], int(sys.argv[4]))
    ends = problem.timed(work, lambda ends: ends[:, 3].sum() * elements)
    problem.write(sys.argv[5], ends)
