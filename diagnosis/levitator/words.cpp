#include "diagnosis/levitator/words.hpp"

namespace levitas::levitator {

const std::vector<effect::Words>& OwnWords() {
  static const std::vector<effect::Words> kRows{
      {"rotor_mass", "Ball is heavier than the file says", "Ball is lighter than the file says",
       "ratio", effect::SizeForm::kOff, "", effect::Yardstick::kNone, effect::Stop::kRunOn,
       "The loop has another gain, and another current carries it.",
       "Weigh the ball; correct the file."}};
  return kRows;
}

}  // namespace levitas::levitator
