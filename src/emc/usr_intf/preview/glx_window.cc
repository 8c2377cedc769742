// SPDX-License-Identifier: GPL-2.0-or-later
// Python module kerf_glx: an OpenGL context in a window of another program's widget.
//
// The window is a child of the widget's X window, with a visual of its own; it selects no keys and
// no mouse events, so that the widget gets them. Errors of X on this connection become Python
// exceptions; Xlib alone would end the process.
#include <pybind11/pybind11.h>

#include <GL/glx.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <set>
#include <stdexcept>
#include <string>

namespace py = pybind11;

namespace {

std::set<Display *> ours;
int last_error = 0;
int (*others)(Display *, XErrorEvent *) = nullptr;

int on_error(Display *display, XErrorEvent *event)
{
    if (!ours.count(display)) return others ? others(display, event) : 0;
    last_error = event->error_code;
    return 0;
}

class Window_ {
public:
    Window_(const std::string &display_name, unsigned long parent, bool classic)
    {
        display_ = XOpenDisplay(display_name.empty() ? nullptr : display_name.c_str());
        if (!display_) throw std::runtime_error("the display " + display_name + " cannot be opened");
        ours.insert(display_);
        auto before = XSetErrorHandler(on_error);
        if (before != on_error) others = before;
        try {
            make(parent, classic);
        } catch (...) {
            close();
            throw;
        }
    }
    ~Window_() { close(); }
    Window_(const Window_ &) = delete;
    Window_ &operator=(const Window_ &) = delete;

    void make_current()
    {
        need();
        if (!glXMakeCurrent(display_, window_, context_))
            throw std::runtime_error("OpenGL: the context cannot be made current");
        check("make_current");
    }
    void swap()
    {
        need();
        glXSwapBuffers(display_, window_);
        check("swap");
    }
    void resize(int width, int height)
    {
        need();
        if (width < 1 || height < 1) throw std::invalid_argument("resize: width and height must be 1 pixel or more");
        XResizeWindow(display_, window_, unsigned(width), unsigned(height));
        XSync(display_, False);
        check("resize");
    }
    /// True when a part of the window has to be drawn anew since the last call.
    bool exposed()
    {
        need();
        bool found = false;
        XEvent event;
        while (XPending(display_)) {
            XNextEvent(display_, &event);
            found = found || event.type == Expose;
        }
        return found;
    }
    void close()
    {
        if (!display_) return;
        glXMakeCurrent(display_, None, nullptr);
        if (context_) glXDestroyContext(display_, context_);
        if (window_) XDestroyWindow(display_, window_);
        if (colormap_) XFreeColormap(display_, colormap_);
        XSync(display_, False); // errors (a widget that is gone) come while the display is still ours
        XCloseDisplay(display_);
        ours.erase(display_);
        display_ = nullptr;
    }

private:
    void need() const
    {
        if (!display_) throw std::runtime_error("the OpenGL window is closed");
    }
    void check(const char *what)
    {
        if (!last_error) return;
        char text[200];
        XGetErrorText(display_, last_error, text, sizeof text);
        last_error = 0;
        throw std::runtime_error(std::string("OpenGL window: ") + what + ": " + text);
    }
    void make(unsigned long parent, bool classic)
    {
        int first_error, first_event;
        if (!glXQueryExtension(display_, &first_error, &first_event))
            throw std::runtime_error("the display has no GLX (OpenGL for X)");
        const int screen = DefaultScreen(display_);
        const int wanted[] = {GLX_X_RENDERABLE,
                              True,
                              GLX_DRAWABLE_TYPE,
                              GLX_WINDOW_BIT,
                              GLX_RENDER_TYPE,
                              GLX_RGBA_BIT,
                              GLX_X_VISUAL_TYPE,
                              GLX_TRUE_COLOR,
                              GLX_RED_SIZE,
                              8,
                              GLX_GREEN_SIZE,
                              8,
                              GLX_BLUE_SIZE,
                              8,
                              GLX_DOUBLEBUFFER,
                              True,
                              GLX_DEPTH_SIZE,
                              classic ? 16 : 0,
                              None};
        int count = 0;
        GLXFBConfig *configs = glXChooseFBConfig(display_, screen, wanted, &count);
        if (!configs || count < 1) throw std::runtime_error("the display has no OpenGL visual with 24 bits of colour");
        const GLXFBConfig config = best(configs, count);
        XFree(configs);
        XVisualInfo *visual = glXGetVisualFromFBConfig(display_, config);
        if (!visual) throw std::runtime_error("the OpenGL configuration has no visual");
        colormap_ = XCreateColormap(display_, RootWindow(display_, screen), visual->visual, AllocNone);
        XSetWindowAttributes attributes{};
        attributes.colormap = colormap_;
        attributes.event_mask = ExposureMask;
        window_ = XCreateWindow(display_, parent, 0, 0, 16, 16, 0, visual->depth, InputOutput, visual->visual,
                                CWColormap | CWEventMask | CWBorderPixel | CWBackPixel, &attributes);
        XFree(visual);
        XSync(display_, False);
        check("window");
        context_ = classic ? glXCreateNewContext(display_, config, GLX_RGBA_TYPE, nullptr, True) : core_context(config);
        XSync(display_, False);
        if (!context_ || last_error) {
            last_error = 0;
            throw std::runtime_error(classic ? "the display makes no OpenGL context"
                                             : "the display's OpenGL is older than 3.3");
        }
        XMapWindow(display_, window_);
        XSync(display_, False);
        check("map");
    }
    GLXContext core_context(GLXFBConfig config)
    {
        auto create = reinterpret_cast<PFNGLXCREATECONTEXTATTRIBSARBPROC>(
            glXGetProcAddressARB(reinterpret_cast<const GLubyte *>("glXCreateContextAttribsARB")));
        static const int version[] = {
            GLX_CONTEXT_MAJOR_VERSION_ARB,    3,   GLX_CONTEXT_MINOR_VERSION_ARB, 3, GLX_CONTEXT_PROFILE_MASK_ARB,
            GLX_CONTEXT_CORE_PROFILE_BIT_ARB, None};
        return create ? create(display_, config, nullptr, True, version) : nullptr;
    }
    /// Without buffers that are not used; depth and samples are in frame buffers of the picture.
    GLXFBConfig best(GLXFBConfig *configs, int count)
    {
        GLXFBConfig found = configs[0];
        int least = 1 << 30;
        for (int i = 0; i < count; ++i) {
            int depth = 0, alpha = 0, samples = 0;
            glXGetFBConfigAttrib(display_, configs[i], GLX_DEPTH_SIZE, &depth);
            glXGetFBConfigAttrib(display_, configs[i], GLX_ALPHA_SIZE, &alpha);
            glXGetFBConfigAttrib(display_, configs[i], GLX_SAMPLES, &samples);
            const int cost = depth + 2 * alpha + 100 * samples;
            if (cost < least) {
                least = cost;
                found = configs[i];
            }
        }
        return found;
    }

    Display *display_ = nullptr;
    Window window_ = 0;
    Colormap colormap_ = 0;
    GLXContext context_ = nullptr;
};

} // namespace

PYBIND11_MODULE(kerf_glx, m)
{
    m.doc() = "An OpenGL context (3.3 core, or a classic one) in a widget's X window.";
    py::class_<Window_>(m, "Window", "A child window of a widget, with a context. One thread at a time.")
        .def(py::init<const std::string &, unsigned long, bool>(), py::arg("display"), py::arg("parent"),
             py::arg("classic") = false,
             "display: its name (\"\": $DISPLAY); parent: X window id; classic: a context with fixed functions and "
             "depth "
             "instead of a core one. RuntimeError says why there is no OpenGL.")
        .def("make_current", &Window_::make_current)
        .def("swap", &Window_::swap, "Shows what was drawn.")
        .def("resize", &Window_::resize, py::arg("width"), py::arg("height"), "Pixels.")
        .def("exposed", &Window_::exposed, "True when the window has to be drawn anew since the last call.")
        .def("close", &Window_::close);
}
