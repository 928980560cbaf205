"""A mass on a sample on a shaker, simulated without anything of the program: SciPy's solve_ivp with error control
for what is not linear (DOP853, or RK45 where the force has corners), and in closed form (a sum of sines and the free
response) for linear samples. All records are synthetic."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

MASS = 1.12                       # [kg]
OMEGA = 2 * np.pi * 250.0         # resonance [rad/s]
STIFFNESS = MASS * OMEGA**2       # [N/m]
DAMPING = 2 * 0.04 * MASS * OMEGA # [N s/m]
SCALE = 2e-4                      # displacement at which the polynomial's terms are compared [m]
VELOCITY = 0.3                    # V of c v |v/V|^lambda [m/s]
RATE = 6000.0                     # [Hz]


class Sweep:
    """100 to 420 Hz in six seconds, with ramps."""
    low, high, duration, level = 100.0, 420.0, 6.0, 100.0

    def __init__(self, level=100.0):
        self.level = level

    def __call__(self, t):
        slope = (self.high - self.low) / self.duration
        ramp = 0.01 * self.duration
        end = np.clip(np.minimum(t, self.duration - t), 0.0, ramp)
        return self.level * np.sin(2 * np.pi * (self.low + 0.5 * slope * t) * t) * np.sin(0.5 * np.pi * end / ramp)**2


class Random:
    """Sines of random frequency, one in each of equal intervals, and random phase: 20 to 850 Hz, 60 m/s^2 rms."""
    low, high, duration, level = 20.0, 850.0, 20.0, 60.0

    def __init__(self, seed=1, level=60.0, duration=20.0, lines=600):
        draw = np.random.default_rng(seed)
        self.duration, self.level = duration, level
        frequency = self.low + (self.high - self.low) * (np.arange(lines) + draw.random(lines)) / lines
        self.omega = 2 * np.pi * frequency
        self.amplitude = level * np.sqrt(2 / lines) * np.exp(2j * np.pi * draw.random(lines))

    def sines(self, t, factor=1.0):
        sum_ = np.zeros(len(t))
        for omega, amplitude in zip(self.omega, factor * self.amplitude):
            sum_ += (amplitude * np.exp(1j * omega * t)).real
        return sum_

    def spline(self):
        t = np.arange(0.0, self.duration + 1e-3, 1.0 / 24000.0)
        return CubicSpline(t, self.sines(t))


class Sample:
    """c v |v/V|^lambda + k1 z + k2 z^2 ... + terms beta/(alpha + s) on v (complex ones stand for a pair) + `force` of
    internal states: force(t, z, v, w) gives an added force and the rates of w. Lists of Samples of one kind are
    integrated together."""

    def __init__(self, k=(STIFFNESS,), c=DAMPING, exponent=0.0, alpha=(), beta=(), force=None, internal=0, mass=MASS):
        self.k, self.c, self.exponent, self.mass = list(k), c, exponent, mass
        self.alpha, self.beta = list(alpha), list(beta)
        self.force, self.internal = force, internal


def polynomial(relative, first=STIFFNESS):
    """k1 ... of numbers relative to k1 at the displacement SCALE."""
    return [first] + [r * first / SCALE**(i + 1) for i, r in enumerate(relative)]


def integrated(samples, base, rate=RATE):
    """z'' of each sample, a row each; base acceleration at the same times."""
    n, first = len(samples), samples[0]
    k = np.array([s.k for s in samples]).T
    c, m = np.array([s.c for s in samples]), np.array([s.mass for s in samples])
    exponent = np.array([s.exponent for s in samples])
    alpha = np.array([s.alpha for s in samples], dtype=complex).reshape(n, -1).T
    beta = np.array([s.beta for s in samples], dtype=complex).reshape(n, -1).T
    beta = np.where(alpha.imag != 0.0, 2 * beta, beta)
    terms, drive = len(alpha), base.spline() if hasattr(base, "spline") else base

    def total(t, x):
        z, v = x[0], x[1]
        w = x[2:2 + terms] + 1j * x[2 + terms:2 + 2 * terms]
        power = np.zeros_like(z)
        for coefficient in k[::-1]:
            power = (power + coefficient) * z
        force = power + c * v * (np.abs(v) / VELOCITY)**exponent if exponent.any() else power + c * v
        force = force + (beta * w).real.sum(axis=0)
        rates = np.zeros((0, n))
        if first.force:
            own, rates = first.force(t, z, v, x[2 + 2 * terms:])
            force = force + own
        return force, w, rates

    def slope(t, flat):
        x = flat.reshape(-1, n)
        force, w, rates = total(t, x)
        moved = x[1] - alpha * w if terms else w
        return np.concatenate([x[1], -drive(t) - force / m, moved.real.ravel(), moved.imag.ravel(),
                               np.asarray(rates, dtype=float).ravel()])

    t = np.arange(int(round(base.duration * rate))) / rate
    start = np.zeros((2 + 2 * terms + first.internal) * n)
    # Forces with corners make short steps, and need not be met to more digits than the noise leaves.
    method, rtol, atol = ("RK45", 1e-5, 1e-9) if first.force else ("DOP853", 1e-9, 1e-13)
    found = solve_ivp(slope, (0.0, t[-1]), start, method, t_eval=t, rtol=rtol, atol=atol, max_step=1 / 1500)
    if not found.success:
        raise RuntimeError(found.message)
    y = drive(t)
    states = found.y.reshape(-1, n, len(t))
    relative = np.empty((n, len(t)))
    for i in range(len(t)):
        relative[:, i] = -y[i] - total(t[i], states[:, :, i])[0] / m
    return y, relative


def dynamic_stiffness(sample, s):
    """k + c s + s sum of beta/(s + alpha) of a linear sample."""
    total = sample.k[0] + sample.c * s
    for alpha, beta in zip(sample.alpha, sample.beta):
        total = total + s * beta / (s + alpha)
        if np.imag(alpha):
            total = total + s * np.conj(beta) / (s + np.conj(alpha))
    return total


def by_fourier(sample, base, rate=RATE, finer=4):
    """z'' of a linear sample from rest under a sweep, which begins and ends at rest: transformed at a finer rate, with two
    seconds of rest behind it."""
    n = int(round(base.duration * rate)) * finer
    y = np.zeros(n + int(2 * rate) * finer)
    y[:n] = base(np.arange(n) / (rate * finer))
    s = 2j * np.pi * np.fft.rfftfreq(len(y), 1 / (rate * finer))
    z = -sample.mass * s**2 / (dynamic_stiffness(sample, s) + sample.mass * s**2) * np.fft.rfft(y)
    return y[:n:finer], np.fft.irfft(z, len(y))[:n:finer]


def linear(sample, base, rate=RATE):
    """z'' of a linear sample from rest under a sum of sines: the forced response, and the free one that brings z, v and
    the terms' states to rest at the start. Under a sweep by_fourier()."""
    if not hasattr(base, "omega"):
        return by_fourier(sample, base, rate)
    alpha = np.array(sample.alpha, dtype=complex)
    beta = np.array(sample.beta, dtype=complex)
    pairs = alpha.imag != 0.0
    alpha, beta = np.concatenate([alpha, alpha[pairs].conj()]), np.concatenate([beta, beta[pairs].conj()])
    s = 1j * base.omega
    dynamic = sample.k[0] + sample.c * s + s * (beta[:, None] / (s + alpha[:, None])).sum(axis=0)
    z = -sample.mass * base.amplitude / (dynamic + sample.mass * s**2)
    t = np.arange(int(round(base.duration * rate))) / rate
    A = np.zeros((2 + len(alpha), 2 + len(alpha)), dtype=complex)
    A[0, 1] = 1.0
    A[1, :2] = -sample.k[0] / sample.mass, -sample.c / sample.mass
    A[1, 2:] = -beta / sample.mass
    A[2:, 1] = 1.0
    A[2:, 2:] = -np.diag(alpha)
    forced = np.array([z.real.sum(), (s * z).real.sum()], dtype=complex)
    w = ((s * z) / (s + alpha[:, None]) + (s * z).conj() / (s.conj() + alpha[:, None])).sum(axis=1) / 2
    values, vectors = np.linalg.eig(A)
    weights = np.linalg.solve(vectors, -np.concatenate([forced, w]))
    free = sum((weights[i] * vectors[1, i] * values[i] * np.exp(values[i] * t)).real for i in range(len(values)))
    relative = free.copy()
    for omega, amplitude in zip(base.omega, s**2 * z):
        relative += (amplitude * np.exp(1j * omega * t)).real
    return base.sines(t), relative


def steady_random(sample, level, duration, seed, rate=RATE, low=Random.low, high=Random.high):
    """Base and z'' of a linear sample in stationary random motion: Gaussian noise of a flat density between low and high [Hz],
    level: its rms [m/s^2]. All frequencies of the record are there, as on a shaker; it repeats after its duration."""
    n = int(round(duration * rate))
    draw, s = np.random.default_rng(seed), 2j * np.pi * np.fft.rfftfreq(n, 1 / rate)
    within = (abs(s) >= 2 * np.pi * low) & (abs(s) <= 2 * np.pi * high)
    y = within * (draw.standard_normal(len(s)) + 1j * draw.standard_normal(len(s)))
    y *= level / np.sqrt(np.mean(np.fft.irfft(y, n)**2))
    z = -sample.mass * s**2 / (dynamic_stiffness(sample, s) + sample.mass * s**2) * y
    return np.fft.irfft(y, n), np.fft.irfft(z, n)


def noisy(base, relative, decibel, seed):
    """White noise so far below the rms of each channel."""
    draw = np.random.default_rng(seed)
    part = 10**(-decibel / 20)
    return tuple(x + part * np.sqrt(np.mean(x**2)) * draw.standard_normal(len(x)) for x in (base, relative))
