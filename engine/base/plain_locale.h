// Decimal points for what reads numbers in the locale of the process, as Python's or a window system's may have been set.
#pragma once

#include <clocale>

namespace scree {

// This thread's numbers are read and written as in C while it lives.
class PlainLocale {
 public:
  PlainLocale() : plain_(::newlocale(LC_ALL_MASK, "C", nullptr)), before_(::uselocale(plain_)) {}
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;
  ~PlainLocale() {
    ::uselocale(before_);
    ::freelocale(plain_);
  }

 private:
  locale_t plain_;
  locale_t before_;
};

}  // namespace scree
