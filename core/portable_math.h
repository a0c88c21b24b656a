// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

// Elementary functions from IEEE operations alone: a C library may pick other code on another processor and so other
// last bits, these cannot. They vectorise. Compiled without contraction (CMakeLists.txt).
namespace standpoint::portable {

#define STANDPOINT_INLINE inline __attribute__((always_inline))

// log2 of a positive normal number, relative error below 3e-7 of max(1, |log2|).
STANDPOINT_INLINE float log2(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  const std::uint32_t from_root_half = bits - 0x3F3504F3U;  // of sqrt(1/2)
  const auto exponent = static_cast<float>(static_cast<std::int32_t>(from_root_half) >> 23);
  const std::uint32_t mantissa_bits = (from_root_half & 0x007FFFFFU) + 0x3F3504F3U;
  float mantissa;
  std::memcpy(&mantissa, &mantissa_bits, sizeof mantissa);
  const float s = (mantissa - 1) / (mantissa + 1);  // ln m = 2 artanh s, |s| < 0.172
  const float q = s * s;
  const float artanh = s * (1 + q * (1.0F / 3 + q * (1.0F / 5 + q * (1.0F / 7 + q * (1.0F / 9)))));
  return exponent + 2.885390081777927F * artanh;  // 2 / ln 2
}

// sin and cos of 2πu for u in [0, 1], absolute error below 4e-7.
STANDPOINT_INLINE void sinCosTurn(float u, float& sine, float& cosine) {
  const auto quarter = static_cast<std::int32_t>(u * 4 + 0.5F);
  const float x = 6.283185307179586F * (u - 0.25F * static_cast<float>(quarter));
  const float q = x * x;
  const float s = x * (1 - q / 6 * (1 - q / 20 * (1 - q / 42 * (1 - q / 72))));
  const float c = 1 - q / 2 * (1 - q / 12 * (1 - q / 30 * (1 - q / 56)));
  const bool odd = (quarter & 1) != 0;
  const float sine_of_turn = odd ? c : s;
  const float cosine_of_turn = odd ? s : c;
  sine = (quarter & 2) != 0 ? -sine_of_turn : sine_of_turn;
  cosine = ((quarter + 1) & 2) != 0 ? -cosine_of_turn : cosine_of_turn;
}

// 2^x for x from -120 to 120, relative error below 3e-7.
STANDPOINT_INLINE float exp2(float x) {
  const auto shifted = static_cast<std::int32_t>(x + 127.5F);  // truncation is rounding of what is positive
  const float rest = (x - static_cast<float>(shifted - 127)) * 0.6931471805599453F;  // |rest| < 0.35
  const float upper = 1.0F / 6 + rest * (1.0F / 24 + rest * (1.0F / 120 + rest * (1.0F / 720)));
  const float series = 1 + rest * (1 + rest * (1.0F / 2 + rest * upper));
  const std::int32_t bits = shifted * (1 << 23);
  float power;
  std::memcpy(&power, &bits, sizeof power);
  return power * series;
}

// The angle of (x, y) in turns, -1/2 to 1/2, absolute error below 1e-12.
inline double turnOf(double y, double x) {
  if (x == 0 && y == 0) return 0;
  // Halving the angle three times leaves less than π/8, where sixteen terms of the series are enough.
  for (int k = 0; k < 3; ++k) {
    const double length = std::sqrt(x * x + y * y);
    if (x < 0) {  // without cancellation: (x + length) = y² / (length - x)
      const double sum = y * y / (length - x);
      x = sum;
      if (sum == 0) y = std::copysign(1.0, y);  // half of a half turn is a quarter
    } else {
      x += length;
    }
  }
  const double z = y / x, q = z * z;
  double sum = 0;
  for (int k = 33; k > 0; k -= 2) sum = 1.0 / k - q * sum;
  return 8 * z * sum / (2 * 3.14159265358979323846);
}

// sin and cos of an angle of a few turns, absolute error below 1e-15 within a turn.
STANDPOINT_INLINE void sinCos(double radians, double& sine, double& cosine) {
  const double quarter = std::floor(radians * 0.6366197723675814 + 0.5);  // 2 / π
  const double x = (radians - quarter * 1.5707963267948966) - quarter * 6.123233995736766e-17;
  const double q = x * x;
  double s = 0, c = 0;
  for (int n = 20; n > 0; n -= 2) {
    c = 1 - q / (n * (n - 1)) * (n == 20 ? 1 : c);
    s = 1 - q / (n * (n + 1)) * (n == 20 ? 1 : s);
  }
  s *= x;
  const auto turned = static_cast<int>(quarter) & 3;
  sine = turned == 0 ? s : turned == 1 ? c : turned == 2 ? -s : -c;
  cosine = turned == 0 ? c : turned == 1 ? -s : turned == 2 ? -c : s;
}

// ln of a positive normal number, relative error below 1e-15 of max(1, |ln|).
inline double log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // [1/2, 1)
  if (mantissa < 0.7071067811865476) {
    mantissa *= 2;
    --exponent;
  }
  const double s = (mantissa - 1) / (mantissa + 1);  // ln m = 2 artanh s, |s| < 0.172
  const double q = s * s;
  constexpr double kSeries[] = {1.0 / 21, 1.0 / 19, 1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11,
                                1.0 / 9,  1.0 / 7,  1.0 / 5,  1.0 / 3,  1};
  double sum = 0;
  for (const double coefficient : kSeries) sum = sum * q + coefficient;
  return exponent * 0.6931471805599453 + 2 * s * sum;
}

// e^x for |x| up to 700, relative error below 2e-16 (1 + |x|).
inline double exp(double x) {
  const double turns = std::floor(x * 1.4426950408889634 + 0.5);  // 1 / ln 2
  const double rest = x - turns * 0.6931471805599453;
  constexpr double kInverse[] = {1.0 / 15, 1.0 / 14, 1.0 / 13, 1.0 / 12, 1.0 / 11, 1.0 / 10, 1.0 / 9, 1.0 / 8,
                                 1.0 / 7,  1.0 / 6,  1.0 / 5,  1.0 / 4,  1.0 / 3,  1.0 / 2,  1};
  double sum = 1;  // |rest| < 0.35
  for (const double inverse : kInverse) sum = 1 + sum * rest * inverse;
  return std::ldexp(sum, static_cast<int>(turns));
}

// base^exponent of a positive base.
inline double pow(double base, double exponent) { return exp(exponent * log(base)); }

}  // namespace standpoint::portable
