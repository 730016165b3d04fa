#pragma once

namespace grove::integration {

/// A scene that is loaded at once, whose objects can be shared out among nodes by type or by name.
inline constexpr const char* kStones = R"(name = 'stones'
spawn = [0, 0, 6]
[[object]]
type = 'sky'
[[object]]
type = 'ground'
[[object]]
type = 'mesh'
name = 'left'
shape = 'rocks'
position = [-1.5, 0, 1]
[[object]]
type = 'mesh'
name = 'right'
shape = 'stone'
position = [1.5, 0, 2]
[visitor]
type = 'figure'
)";

}  // namespace grove::integration
