#pragma once

// As cmake/precompiled.h, for the test programs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cmake/precompiled.h"
