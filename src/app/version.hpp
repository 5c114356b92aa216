// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace engrane::app {

inline constexpr const char* version = ENGRANE_VERSION;

}  // namespace engrane::app
