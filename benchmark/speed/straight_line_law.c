#include "benchmark/speed/straight_line_law.h"

void straight_line_step(struct straight_line_law* law, const double* error_m,
                        const double* excitation_a, double* current_a) {
  for (int i = 0; i < 4; ++i) {
    const double a = law->lead_b0[i] * error_m[i] + law->lead_s[i];
    law->lead_s[i] = law->lead_b1[i] * error_m[i] - law->lead_a1[i] * a;

    const double b = law->notch_b0[0][i] * a + law->notch_s1[0][i];
    law->notch_s1[0][i] = law->notch_b1[0][i] * a - law->notch_a1[0][i] * b + law->notch_s2[0][i];
    law->notch_s2[0][i] = law->notch_b2[0][i] * a - law->notch_a2[0][i] * b;

    const double c = law->notch_b0[1][i] * b + law->notch_s1[1][i];
    law->notch_s1[1][i] = law->notch_b1[1][i] * b - law->notch_a1[1][i] * c + law->notch_s2[1][i];
    law->notch_s2[1][i] = law->notch_b2[1][i] * b - law->notch_a2[1][i] * c;

    const double wanted =
        law->direct[i] * c + law->integral[i] + law->derivative[i] + excitation_a[i];
    law->derivative[i] = law->derivative_gain[i] * c + law->derivative_pole[i] * law->derivative[i];
    const double high = wanted > law->limit ? law->limit : wanted;
    const double given = high < -law->limit ? -law->limit : high;
    const double increment = law->integral_gain[i] * c;
    if (given == wanted || increment * wanted <= 0.0) law->integral[i] += increment;
    current_a[i] = given;
  }
}
