#include "user_input.h"

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <stdexcept>

namespace weft {

struct UserInput::Impl {
    Display* display = nullptr;
    Window root = 0, window = 0;
    Time now = 1000;  // ms; grows with each event

    Atom atom(const char* name) const { return XInternAtom(display, name, False); }
    std::string title_of(Window one) const {
        char* name = nullptr;
        if (!XFetchName(display, one, &name) || !name) return {};
        std::string title = name;
        XFree(name);
        return title;
    }
    void find(const std::string& title) {
        Window unused = 0, *children = nullptr;
        unsigned count = 0;
        XQueryTree(display, root, &unused, &unused, &children, &count);
        for (unsigned i = 0; i < count; ++i)
            if (title_of(children[i]).starts_with(title)) window = children[i];
        if (children) XFree(children);
        if (!window) throw std::runtime_error("there is no window '" + title + "'");
    }
    // Fields that key and button events share.
    template <class Event>
    void fill(Event& event, int type) {
        event.type = type;
        event.display = display;
        event.window = window;
        event.root = root;
        event.same_screen = True;
        event.time = ++now;
    }
    void send(XEvent& event, long mask) {
        XSendEvent(display, window, False, mask, &event);
        XSync(display, False);
    }
};

UserInput::UserInput(const std::string& title) : impl_(std::make_unique<Impl>()) {
    impl_->display = XOpenDisplay(nullptr);
    if (!impl_->display) throw std::runtime_error("there is no display");
    impl_->root = DefaultRootWindow(impl_->display);
    try {
        impl_->find(title);
    } catch (...) {
        XCloseDisplay(impl_->display);
        throw;
    }
}

UserInput::~UserInput() {
    XCloseDisplay(impl_->display);
}

std::array<int, 3> UserInput::color(int x, int y) const {
    XImage* image = XGetImage(impl_->display, impl_->root, x, y, 1, 1, AllPlanes, ZPixmap);
    if (!image) throw std::runtime_error("there is no such place on the screen");
    const unsigned long pixel = XGetPixel(image, 0, 0);
    XDestroyImage(image);
    return {static_cast<int>(pixel >> 16 & 255), static_cast<int>(pixel >> 8 & 255), static_cast<int>(pixel & 255)};
}

std::string UserInput::title() const {
    return impl_->title_of(impl_->window);
}

void UserInput::resize(unsigned width, unsigned height) {
    XResizeWindow(impl_->display, impl_->window, width, height);
    XSync(impl_->display, False);
}

void UserInput::set_minimized(bool minimized) {
    const long state[] = {minimized ? IconicState : NormalState, 0};
    const Atom name = impl_->atom("WM_STATE");
    XChangeProperty(impl_->display, impl_->window, name, name, 32, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(state), 2);
    XSync(impl_->display, False);
}

void UserInput::ask_to_close() {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = impl_->window;
    event.xclient.message_type = impl_->atom("WM_PROTOCOLS");
    event.xclient.format = 32;
    event.xclient.data.l[0] = static_cast<long>(impl_->atom("WM_DELETE_WINDOW"));
    impl_->send(event, NoEventMask);
}

void UserInput::point_at(int x, int y) {
    XWarpPointer(impl_->display, 0, impl_->window, 0, 0, 0, 0, x, y);
    XSync(impl_->display, False);
}

void UserInput::button(unsigned number, bool down) {
    XEvent event{};
    impl_->fill(event.xbutton, down ? ButtonPress : ButtonRelease);
    event.xbutton.button = number;
    impl_->send(event, down ? ButtonPressMask : ButtonReleaseMask);
}

void UserInput::key(const std::string& name, bool down) {
    XEvent event{};
    impl_->fill(event.xkey, down ? KeyPress : KeyRelease);
    event.xkey.keycode = XKeysymToKeycode(impl_->display, XStringToKeysym(name.c_str()));
    impl_->send(event, down ? KeyPressMask : KeyReleaseMask);
}

}  // namespace weft
