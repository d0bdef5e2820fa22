// SPDX-License-Identifier: MIT
#pragma once
#include <sphmbs/sph/target.hpp>
