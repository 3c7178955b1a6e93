// study_against_the_paper: the table of docs/against_the_paper.md, from configs/01 and 12 as they are now.
#include <cstdio>

#include "run/against_the_paper.h"

int main() {
  std::fputs(gapscope::test::against_the_paper().c_str(), stdout);
  return 0;
}
