/* The same filters as one would write them by hand for four axes: PID + lead-lag + two notches,
 * transposed direct form II, limit and conditional integration, no abstraction, plain C. The
 * yardstick of cycle_bench. One array per number, one entry per axis. */
#ifndef LEVITAS_BENCH_STRAIGHT_LINE_LAW_H_
#define LEVITAS_BENCH_STRAIGHT_LINE_LAW_H_

#ifdef __cplusplus
extern "C" {
#endif

struct straight_line_law {
  double lead_b0[4], lead_b1[4], lead_a1[4], lead_s[4];
  double notch_b0[2][4], notch_b1[2][4], notch_b2[2][4], notch_a1[2][4], notch_a2[2][4];
  double notch_s1[2][4], notch_s2[2][4];
  double direct[4], integral_gain[4], derivative_gain[4], derivative_pole[4];
  double integral[4], derivative[4];
  double limit;
};

void straight_line_step(struct straight_line_law* law, const double* error_m,
                        const double* excitation_a, double* current_a);

/* A state-space law of pairs between four axes, its limit and the test of saturation, by hand. */
enum { STRAIGHT_PAIRS = 34 };
struct straight_line_modal {
  double real[STRAIGHT_PAIRS], imaginary[STRAIGHT_PAIRS];
  double input1[4][STRAIGHT_PAIRS], input2[4][STRAIGHT_PAIRS];
  double output1[4][STRAIGHT_PAIRS], output2[4][STRAIGHT_PAIRS];
  double direct[4][4];
  double input_gain[4], output_gain[4];
  double state1[STRAIGHT_PAIRS], state2[STRAIGHT_PAIRS];
  double limit;
};

void straight_line_modal_step(struct straight_line_modal* law, const double* error_m,
                              const double* excitation_a, double* current_a);

#ifdef __cplusplus
}
#endif

#endif /* LEVITAS_BENCH_STRAIGHT_LINE_LAW_H_ */
