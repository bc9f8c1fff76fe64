// Front end of spdlog: the only place that includes it, apart from applications that set its level.
#pragma once
#include <spdlog/spdlog.h>

namespace gault::core {
namespace log = spdlog;
}
