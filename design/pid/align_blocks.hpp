#pragma once
// Two state-space laws of modal blocks, in coordinates in which a law between them makes sense.
//
// Freedom    blocks of a law may stand in any order, and a block's states may be turned and scaled:
//            with w' = s w for a complex number s (a real one for one state) inputs become s b and
//            outputs c/s, and the law is the same. Numbers between those of two laws mean something
//            only in coordinates in which the same state is the same thing in both.
// Method     each block of `reference` gets the block of `other` of its kind whose pole is nearest
//            and, where several are as near (x and y, integrators), which reads the same axes,
//            nearest pairs first; then s = <b, b_ref>/<b, b>, which brings its inputs nearest to
//            those of the reference. An input of zero leaves s at 1.
// Not done   laws of different order, or with another number of real poles: returned as they are,
//            for WhyNoSchedule to refuse.
// Thread     any; pure.

#include "controller/law/law_config.hpp"

namespace levitas::design {

[[nodiscard]] law::StateSpaceConfig AlignBlocks(const law::StateSpaceConfig& reference,
                                                const law::StateSpaceConfig& other);

}  // namespace levitas::design
