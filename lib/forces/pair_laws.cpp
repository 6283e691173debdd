#include "forces/pair_law.h"

namespace pigment::forces {

#define PAIR_LAW(stem) PairLawEntry stem##_law();
#include "forces/pair_laws.def"
#undef PAIR_LAW

const std::vector<PairLawEntry>& pair_laws() {
  static const std::vector<PairLawEntry> entries = {
#define PAIR_LAW(stem) stem##_law(),
#include "forces/pair_laws.def"
#undef PAIR_LAW
  };
  return entries;
}

}  // namespace pigment::forces
