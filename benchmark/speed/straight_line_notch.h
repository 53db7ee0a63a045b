#pragma once
/* The notch as a programmer of a microcontroller writes it: four axes, one order, no configuration,
   no supervision. What benchmark/speed/synchronous_bench.cpp compares with. */

#ifdef __cplusplus
extern "C" {
#endif

struct straight_line_notch {
  double inverse_real[4][4], inverse_imaginary[4][4]; /* [to][from] */
  double real[4], imaginary[4];
  double rate;
};

/* Takes the turning part out of error_m and adapts. */
void straight_line_notch_step(struct straight_line_notch* notch, double angle_rad, double* error_m);

#ifdef __cplusplus
}
#endif
