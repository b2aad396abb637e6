// Simulates the user and the window manager through X11.
#pragma once

#include <array>
#include <memory>
#include <string>

namespace weft {

class UserInput {
  public:
    /// Finds the window whose title begins with this text. Throws std::runtime_error if there is none.
    explicit UserInput(const std::string& title);
    ~UserInput();

    /// Red, green and blue of a pixel of the screen.
    std::array<int, 3> color(int x, int y) const;
    /// Current value.
    std::string title() const;
    void resize(unsigned width, unsigned height);
    void set_minimized(bool minimized);
    void ask_to_close();
    void point_at(int x, int y);
    /// 1 left, 2 middle, 3 right, 4 and 5 the wheel.
    void button(unsigned number, bool down);
    /// `name`: the name in X11, such as "w", "space", "Escape".
    void key(const std::string& name, bool down);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft
