// Every key of a study file.
#pragma once

#include "engine/base/key_table.h"

namespace scree::study {

const KeyTable& study_keys();

}  // namespace scree::study
