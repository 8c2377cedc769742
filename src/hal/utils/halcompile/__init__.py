# SPDX-License-Identifier: GPL-2.0-or-later
"""halcompile: the compiler of the HAL component language (.comp).

The way of a file through the package:

    text --lexer--> tokens --parser--> nodes (syntax tree)
         --checker--> Component (a checked model) --cgen--> C
                                                  --adoc--> AsciiDoc
                                                  --man---> manual page
    build: make runs over the generated C;  cli: the command line.
"""
