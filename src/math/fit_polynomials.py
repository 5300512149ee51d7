#!/usr/bin/env python3
"""Prints the polynomial coefficients of elementary-inl.h (float) and elementary.cc (double).

Each is a least-squares fit on Chebyshev nodes, in 60 digits, of the smooth function that is left when the part that
must be exact is split off; coefficients are rounded one after the other, lowest first, and the rest is fitted again.
The maximum error is printed beside it. Needs mpmath.
"""
import mpmath as mp

mp.mp.dps = 60


def round_to(value, bits):
    mantissa, exponent = mp.frexp(value)
    return mp.ldexp(mp.nint(mp.ldexp(mantissa, bits)), int(exponent) - bits)


def hexfloat(value):
    return float(value).hex().replace("0000000000000p", "p")


def fit(name, function, low, high, count, bits, exact=None):
    """count coefficients of a polynomial close to function on [low, high]; `exact` gives the first bits of each."""
    samples = 6 * count
    nodes = [(low + high) / 2 + (high - low) / 2 * mp.cos(mp.pi * (2 * k + 1) / (2 * samples)) for k in range(samples)]
    values = [function(x) for x in nodes]
    done = []
    while len(done) < count:
        n = len(done)
        rows = mp.matrix([[x ** j for j in range(n, count)] for x in nodes])
        rest = mp.matrix([v - sum(c * x ** j for j, c in enumerate(done)) for x, v in zip(nodes, values)])
        solution = mp.lu_solve(rows, rest)
        done.append(round_to(solution[0], bits))
    error = max(abs(sum(c * x ** j for j, c in enumerate(done)) - v) for x, v in zip(nodes, values))
    print(f"{name}: max error 2^{float(mp.log(error, 2)):.1f}")
    suffix = "f" if bits == 24 else ""
    print("  " + ", ".join(hexfloat(c) + suffix for c in done))
    return done


def split(name, value, *bits):
    parts = []
    for b in bits:
        parts.append(round_to(value, b))
        value -= parts[-1]
    print(f"{name}: " + ", ".join(hexfloat(p) for p in parts))


def near(f, x, limit):
    """f(x) with its removable singularity at 0 filled in."""
    return limit if abs(x) < mp.mpf(10) ** -25 else f(x)


ln2 = mp.log(2)
half = mp.mpf(1) / 2
root = mp.sqrt(2)


def exp2_rest(f): return near(lambda t: (mp.mpf(2) ** t - 1) / t, f, ln2)
def exp_rest(r): return near(lambda t: (mp.exp(t) - 1 - t) / t ** 2, r, half)
def log_rest(f): return near(lambda t: (mp.log1p(t) - t + t * t / 2) / t ** 3, f, mp.mpf(1) / 3)
def log2_rest(f): return near(lambda t: (mp.log1p(t) / ln2 - t / ln2) / t ** 2, f, -half / ln2)
def sin_rest(z): return near(lambda t: (mp.sin(mp.sqrt(t)) / mp.sqrt(t) - 1) / t, z, -mp.mpf(1) / 6)
def cos_rest(z): return near(lambda t: (mp.cos(mp.sqrt(t)) - 1 + t / 2) / t ** 2, z, mp.mpf(1) / 24)
def atan_rest(z): return near(lambda t: (mp.atan(mp.sqrt(t)) / mp.sqrt(t) - 1) / t, z, -mp.mpf(1) / 3)
def asin_rest(z): return near(lambda t: (mp.asin(mp.sqrt(t)) / mp.sqrt(t) - 1) / t, z, mp.mpf(1) / 6)


def atanh_series(skip):
    """atanh(s) / s = sum of z^k / (2k + 1), z = s^2, from the term z^skip on, times 2 / ln 2."""
    def f(z):
        if z < mp.mpf(10) ** -12:
            return 2 / ln2 * sum(z ** k / (2 * (k + skip) + 1) for k in range(6))
        s = mp.sqrt(z)
        return 2 / ln2 * (mp.atanh(s) / s - sum(z ** k / mp.mpf(2 * k + 1) for k in range(skip))) / z ** skip
    return f


def main():
    low, high = root / 2 - 1, root - 1
    z_log = (high / (2 + high)) ** 2 * mp.mpf("1.01")
    quarter = mp.pi / 4 * mp.mpf("1.001")
    print("// float")
    fit("exp2", exp2_rest, -half, half, 7, 24)
    fit("exp", exp_rest, -ln2 / 2 * mp.mpf("1.001"), ln2 / 2 * mp.mpf("1.001"), 6, 24)
    fit("log", log_rest, low, high, 9, 24)
    fit("log2", log2_rest, low, high, 10, 24)
    fit("pow log2", atanh_series(1), mp.mpf(0), z_log, 4, 24)
    fit("sin", sin_rest, mp.mpf(0), quarter ** 2, 4, 24)
    fit("cos", cos_rest, mp.mpf(0), quarter ** 2, 4, 24)
    fit("atan", atan_rest, mp.mpf(0), mp.mpf(1), 10, 24)
    fit("asin", asin_rest, mp.mpf(0), mp.mpf(1) / 4, 6, 24)
    split("1/ln2", 1 / ln2, 12, 24)
    split("2/ln2", 2 / ln2, 12, 24, 24)
    split("log2(e)", 1 / ln2, 24)
    split("ln2", ln2, 15, 24)
    split("2/pi", 2 / mp.pi, 24)
    split("pi/2", mp.pi / 2, 7, 7, 7, 7, 7, 7, 7, 24)
    split("pi/2 hi lo", mp.pi / 2, 24, 24)
    split("pi hi lo", mp.pi, 24, 24)
    print("// double")
    fit("exp2", exp2_rest, -half, half, 13, 53)
    fit("exp", exp_rest, -ln2 / 2 * mp.mpf("1.001"), ln2 / 2 * mp.mpf("1.001"), 12, 53)
    fit("log2 from z^3", atanh_series(3), mp.mpf(0), z_log, 9, 53)
    fit("sin", sin_rest, mp.mpf(0), quarter ** 2, 6, 53)
    fit("cos", cos_rest, mp.mpf(0), quarter ** 2, 6, 53)
    fit("atan", atan_rest, mp.mpf(0), (root - 1) ** 2 * mp.mpf("1.001"), 13, 53)
    fit("asin", asin_rest, mp.mpf(0), mp.mpf(1) / 4, 14, 53)
    split("2/ln2", 2 / ln2, 53, 53)
    split("2/(3 ln2)", 2 / (3 * ln2), 53, 53)
    split("2/(5 ln2)", 2 / (5 * ln2), 53, 53)
    split("ln2 for exp", ln2, 40, 53)
    split("ln2", ln2, 53, 53)
    split("log2(e)", 1 / ln2, 53)
    split("pi/2", mp.pi / 2, 53, 53)
    split("pi/4", mp.pi / 4, 53, 53)
    split("pi", mp.pi, 53, 53)
    mp.mp.dps = 420
    words = int(mp.floor(2 / mp.pi * mp.mpf(2) ** 1280))
    print("2/pi in 32-bit words:")
    print("  " + ", ".join(f"0x{(words >> (1280 - 32 * (k + 1))) & 0xFFFFFFFF:08x}" for k in range(40)))


if __name__ == "__main__":
    main()
