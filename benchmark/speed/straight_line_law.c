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

void straight_line_modal_step(struct straight_line_modal* law, const double* error_m,
                              const double* excitation_a, double* current_a) {
  double signal[4];
  for (int i = 0; i < 4; ++i) signal[i] = -law->input_gain[i] * error_m[i];
  for (int i = 0; i < 4; ++i) {
    double sum = 0.0;
    for (int k = 0; k < STRAIGHT_PAIRS; ++k)
      sum += law->output1[i][k] * law->state1[k] + law->output2[i][k] * law->state2[k];
    for (int j = 0; j < 4; ++j) sum += law->direct[i][j] * signal[j];
    const double wanted = law->output_gain[i] * sum + excitation_a[i];
    const double high = wanted > law->limit ? law->limit : wanted;
    current_a[i] = high < -law->limit ? -law->limit : high;
  }
  for (int k = 0; k < STRAIGHT_PAIRS; ++k) {
    double next1 = law->real[k] * law->state1[k] + law->imaginary[k] * law->state2[k];
    double next2 = law->real[k] * law->state2[k] - law->imaginary[k] * law->state1[k];
    for (int j = 0; j < 4; ++j) {
      next1 += law->input1[j][k] * signal[j];
      next2 += law->input2[j][k] * signal[j];
    }
    law->state1[k] = next1;
    law->state2[k] = next2;
  }
}
