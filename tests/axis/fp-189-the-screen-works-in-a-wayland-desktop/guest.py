"""A program in a tab of the screen: tells once that it is seen there."""
import sys
import tkinter

root = tkinter.Tk(use=sys.argv[1])
tkinter.Label(root, text="guest").pack()


def look():
    if root.winfo_viewable() and root.winfo_width() > 100:
        open(sys.argv[2], "w").close()
    else:
        root.after(50, look)


look()
root.mainloop()
