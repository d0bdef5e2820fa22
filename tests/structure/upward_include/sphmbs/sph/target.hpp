// SPDX-License-Identifier: MIT
#pragma once
#include "sphmbs/core/upward.hpp"
