#pragma once
// The three answers of a diagnosis. Thread: plain data.

namespace levitas::diagnosis {

enum class Verdict { kNone, kEffect, kUnknown };

}  // namespace levitas::diagnosis
