#include "engine/base/threads.h"

#include <omp.h>

#include "engine/base/check.h"

namespace scree {

int available_processors() {
  return omp_get_num_procs();
}

void use_threads(int count) {
  SCREE_EXPECT(count >= 1);
  omp_set_num_threads(count);
}

int threads_in_use() {
  return omp_get_max_threads();
}

int threads_for(std::size_t rows) {
  return rows < static_cast<std::size_t>(rows_worth_sharing) ? 1 : threads_in_use();
}

}  // namespace scree
