"""Formulas (30)-(36) in fifty digits: the oracle for turning points, periods and places where rounding decides.

Written in theta, term by term as the paper prints them; nothing is rearranged to help floating point.
"""

from mpmath import mp, mpf

mp.dps = 50


def _root(function, low, high):
    return mp.findroot(function, (low, high), solver="anderson", tol=mpf(10) ** -80, verify=False)


class Curve:
    """theta_dot^2 = f(theta) of one top and one (K_J, K_R, E), each taken as the exact value of its float."""

    def __init__(self, top, K_J, K_R, E=0):
        self.a, self.I1, self.I3 = mpf(top.a), mpf(top.I1), mpf(top.I3)
        self.K_J, self.K_R, self.E = mpf(K_J), mpf(K_R), mpf(E)
        self.e = 2 * self.E - self.K_R**2 + self.I1 / self.I3 * self.K_J**2  # 2E'

    def at(self, E):
        return Curve(self, self.K_J, self.K_R, E)

    def f3(self, theta):
        return mp.sqrt(self.I3 + mp.sin(theta) ** 2 + self.I3 / self.I1 * (mp.cos(theta) - self.a) ** 2)

    def omega3(self, theta):
        return self.K_R / self.f3(theta)

    def omega2(self, theta):
        return self.bracket(theta) / mp.sin(theta)

    def bracket(self, theta):
        return self.K_J - self.I3 / self.I1 * (mp.cos(theta) - self.a) * self.K_R / self.f3(theta)

    def f1_squared(self, theta):
        return self.I1 + 1 + self.a**2 - 2 * self.a * mp.cos(theta)

    def f2_squared(self, theta):
        return self.I1 + self.I1 / self.I3 * mp.sin(theta) ** 2 + (mp.cos(theta) - self.a) ** 2

    def U(self, theta):
        theta = mpf(theta)
        centrifugal = self.f2_squared(theta) / mp.sin(theta) ** 2 * self.bracket(theta) ** 2
        return 2 * self.a * (1 - mp.cos(theta)) + centrifugal

    def f(self, theta):
        return (self.e - self.U(mpf(theta))) / self.f1_squared(mpf(theta))

    def energy_of(self, e):
        """E from 2E'."""
        return (e + self.K_R**2 - self.I1 / self.I3 * self.K_J**2) / 2

    def grid(self, n=400):
        """Thetas over (0, pi), dense towards both ends down to 1e-12."""
        middle = [mp.pi * k / n for k in range(1, n)]
        end = [mpf(10) ** (-mpf(k) / 8) for k in range(17, 97)]
        return sorted(middle + end + [mp.pi - x for x in end])

    def _lowest(self, low, high):
        """Minimum of U between two points that bracket one, as a root of U'."""
        return _root(lambda x: mp.diff(self.U, x), low, high)

    def steady(self, n=400):
        """Every minimum of U found on the grid, lowest first."""
        grid = self.grid(n)
        height = [self.U(x) for x in grid]
        found = []
        for k in range(1, len(grid) - 1):
            if height[k] <= height[k - 1] and height[k] < height[k + 1]:
                found.append(self._lowest(grid[k - 1], grid[k + 1]))
        return sorted(found, key=self.U)

    def turning_points(self, n=400):
        """(inner, outer) of each allowed interval, in fifty digits; an end is 0 or pi where f stays positive there."""
        grid = sorted(self.grid(n) + self.steady(n))
        sign = [self.f(x) > 0 for x in grid]
        edges = [mpf(0)] if sign[0] else []
        for k in range(len(grid) - 1):
            if sign[k] != sign[k + 1]:
                edges.append(_root(self.f, grid[k], grid[k + 1]))
        if sign[-1]:
            edges.append(mp.pi)
        return list(zip(edges[::2], edges[1::2], strict=True))

    def time(self, inner, outer, theta):
        """Time from the inner turning point out to theta, by quadrature of d theta / f^(1/2)."""
        width = outer - inner

        def rate(kappa):  # theta = mean - width/2 cos(kappa), from the nearer end so that a pole stays off
            near_inner = inner + width * mp.sin(kappa / 2) ** 2
            near_outer = outer - width * mp.cos(kappa / 2) ** 2
            place = near_inner if 2 * kappa < mp.pi else near_outer
            f = abs(self.f(place))
            return width / 2 * mp.sin(kappa) / mp.sqrt(f) if f else mpf(0)  # a zero of f has no weight in the rule

        end = mp.pi if theta == outer else 2 * mp.asin(mp.sqrt((theta - inner) / width))
        return mp.quad(rate, mp.linspace(0, end, 5))

    def period(self, inner, outer):
        return 2 * self.time(inner, outer, outer)
