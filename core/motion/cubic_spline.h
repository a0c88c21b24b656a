// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace standpoint {

// A cubic spline through N values at ascending places (de Boor, A Practical Guide to Splines, 1978, ch. IV), as a value
// and a slope at each place. Continuous up to the second derivative; at its ends it has the slope of the cubic
// polynomial through the four places there, so that its error falls with the fourth power of the spacing everywhere.
template <std::size_t N>
struct SplineKnot {
  double at = 0;
  std::array<double, N> value{}, slope{};
};

// The derivative at the first of up to four places of the polynomial through them, by divided differences.
template <std::size_t N>
double slopeAtFirst(std::array<const SplineKnot<N>*, 4> knot, std::size_t count, std::size_t k) {
  std::array<double, 4> difference{};
  for (std::size_t i = 0; i < count; ++i) difference[i] = knot[i]->value[k];
  double slope = 0, product = 1;
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t i = count - 1; i >= order; --i)
      difference[i] = (difference[i] - difference[i - 1]) / (knot[i]->at - knot[i - order]->at);
    if (order > 1) product *= knot[0]->at - knot[order - 1]->at;
    slope += difference[order] * product;
  }
  return slope;
}

// Fills the slopes of knots whose places and values are set.
template <std::size_t N>
void fillSlopes(std::span<SplineKnot<N>> knots) {
  const std::size_t count = knots.size(), last = count - 1;
  if (count < 2) return;
  std::array<const SplineKnot<N>*, 4> begin{}, end{};
  const std::size_t used = std::min<std::size_t>(4, count);
  for (std::size_t i = 0; i < used; ++i) {
    begin[i] = &knots[i];
    end[i] = &knots[last - i];
  }
  for (std::size_t k = 0; k < N; ++k) {
    knots[0].slope[k] = slopeAtFirst<N>(begin, used, k);
    knots[last].slope[k] = slopeAtFirst<N>(end, used, k);
  }
  // slope[i-1]/a + 2 slope[i] (1/a + 1/b) + slope[i+1]/b = 3 (rise/a² + next rise/b²): equal second derivatives.
  std::vector<double> upper(count, 0);
  for (std::size_t i = 1; i < last; ++i) {
    const double a = 1 / (knots[i].at - knots[i - 1].at), b = 1 / (knots[i + 1].at - knots[i].at);
    const double pivot = 2 * (a + b) - a * upper[i - 1];
    upper[i] = b / pivot;
    for (std::size_t k = 0; k < N; ++k) {
      const double rise = knots[i].value[k] - knots[i - 1].value[k];
      const double next_rise = knots[i + 1].value[k] - knots[i].value[k];
      knots[i].slope[k] = (3 * (rise * a * a + next_rise * b * b) - a * knots[i - 1].slope[k]) / pivot;
    }
  }
  for (std::size_t i = last - 1; i > 0; --i)
    for (std::size_t k = 0; k < N; ++k) knots[i].slope[k] -= upper[i] * knots[i + 1].slope[k];
}

// The first knot of the piece where `at` lies, of knots [first, last]: an index from `first` to `last` - 1.
template <std::size_t N>
std::size_t pieceAt(std::span<const SplineKnot<N>> knots, std::size_t first, std::size_t last, double at) {
  const auto after = std::upper_bound(knots.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                                      knots.begin() + static_cast<std::ptrdiff_t>(last), at,
                                      [](double x, const SplineKnot<N>& knot) { return x < knot.at; });
  return static_cast<std::size_t>(after - knots.begin()) - 1;
}

template <std::size_t N>
std::array<double, N> between(const SplineKnot<N>& from, const SplineKnot<N>& to, double at) {
  const double width = to.at - from.at, u = (at - from.at) / width;
  const double rising = u * u * (3 - 2 * u), slope_from = u * (1 - u) * (1 - u) * width,
               slope_to = -u * u * (1 - u) * width;
  std::array<double, N> result{};
  for (std::size_t k = 0; k < N; ++k)
    result[k] =
        from.value[k] + rising * (to.value[k] - from.value[k]) + slope_from * from.slope[k] + slope_to * to.slope[k];
  return result;
}

// First and second derivative.
template <std::size_t N>
std::array<std::array<double, N>, 2> slopesBetween(const SplineKnot<N>& from, const SplineKnot<N>& to, double at) {
  const double width = to.at - from.at, u = (at - from.at) / width;
  std::array<std::array<double, N>, 2> result{};
  for (std::size_t k = 0; k < N; ++k) {
    const double rise = to.value[k] - from.value[k], a = from.slope[k] * width - rise,
                 b = rise - to.slope[k] * width;  // value = from + u rise + u (1-u) ((1-u) a + u b)
    result[0][k] = (rise + (1 - 2 * u) * ((1 - u) * a + u * b) + u * (1 - u) * (b - a)) / width;
    result[1][k] = 2 * (b - 2 * a + 3 * u * (a - b)) / (width * width);
  }
  return result;
}

}  // namespace standpoint
