#pragma once
// Owners of what libmatio allocates.
//
// Failure  an owner is empty where libmatio returned nothing. Inside session only: no public header
//          includes it, so that nobody else needs libmatio.

#include <matio.h>

#include <memory>

namespace levitas::session {

struct CloseMat {
  void operator()(mat_t* file) const noexcept { (void)Mat_Close(file); }
};
struct FreeMatVariable {
  void operator()(matvar_t* variable) const noexcept { Mat_VarFree(variable); }
};
using MatHandle = std::unique_ptr<mat_t, CloseMat>;
using MatVariable = std::unique_ptr<matvar_t, FreeMatVariable>;

}  // namespace levitas::session
