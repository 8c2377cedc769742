from pathlib import Path

from kerf.tktools.ngcfiles import NotUsable, Program, form_of, frame_lines, start_folder

form = form_of("subs/pocket.ngc")
print(form.info, [(p.number, p.name, p.default, p.label) for p in form.parameters])
for path in sorted(p for p in Path("subs").iterdir() if p.suffix != ".jpg"):
    try:
        form_of(path)
    except NotUsable as error:
        print(error)
gcmc = form_of("subs/shape.gcmc")
print(gcmc.info, gcmc.options, [(p.name, p.default, p.label) for p in gcmc.parameters])
print(frame_lines(":G21;G90"), start_folder(lambda s, n: "subs:other" if n == "SUBROUTINE_PATH" else None),
      start_folder(lambda s, n: None))
for name, expand in (("calls", False), ("expanded", True)):
    program = Program("pre.ngc", ":G4 P0.5")
    for side in ("10", "20.5"):
        program.add(form, [side, "-1", "600", "2"], expand)
    program.write(f"{name}.ngc")
for values in (["1", "2", "", "4"], ["1", "2", "three", "4"], ["2e1", "2", "3", "4"]):
    try:
        program.add(form, values)
    except ValueError as error:
        print(error)
try:
    form_of("expanded.ngc")
except NotUsable as error:
    print(error)
print(Path("calls.ngc").read_text())
Path("subs.ini").write_text("[RS274NGC]\nSUBROUTINE_PATH = subs\n")
