#include "benchmark/speed/straight_line_notch.h"

#include <math.h>

void straight_line_notch_step(struct straight_line_notch* notch, double angle_rad,
                              double* error_m) {
  const double cosine = cos(angle_rad);
  const double sine = sin(angle_rad);
  for (int i = 0; i < 4; ++i) {
    error_m[i] -= notch->real[i] * cosine - notch->imaginary[i] * sine;
  }
  for (int i = 0; i < 4; ++i) {
    double re = 0.0;
    double im = 0.0;
    for (int j = 0; j < 4; ++j) {
      re += notch->inverse_real[i][j] * error_m[j];
      im += notch->inverse_imaginary[i][j] * error_m[j];
    }
    notch->real[i] += notch->rate * (re * cosine + im * sine);
    notch->imaginary[i] += notch->rate * (im * cosine - re * sine);
  }
}
