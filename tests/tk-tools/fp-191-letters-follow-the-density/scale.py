import tkinter as tk
import tkinter.font
from kerf import tkstyle
root = tk.Tk()
style = tkstyle.apply(root)
print(f"  scale {style.scale:.1f}, letters of {-tkinter.font.nametofont('TkDefaultFont').cget('size')} pixels, 72 "
      f"points are {root.winfo_fpixels('72p') / 96:.1f} usual inches")
