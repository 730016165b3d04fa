#pragma once

#include <memory>

#include "world/edits.h"
#include "world/layout.h"
#include "world/players.h"

namespace grove::world {

/// The state that all visitors share, across-user by definition: layout, visitors and their edits. Any thread.
class World {
 public:
  /// `players` may be shared with others; null makes an empty roster.
  explicit World(Layout layout, std::shared_ptr<Players> players = nullptr);

  /// An empty roster for worlds of this layout; `base` as in Players.
  [[nodiscard]] static std::shared_ptr<Players> makePlayers(const Layout& layout, PlayerId base = 0);

  [[nodiscard]] const Layout& layout() const noexcept { return layout_; }
  [[nodiscard]] Players& players() noexcept { return *players_; }
  [[nodiscard]] Edits& edits() noexcept { return edits_; }

 private:
  const Layout layout_;
  const std::shared_ptr<Players> players_;
  Edits edits_;
};

}  // namespace grove::world
