component lubricator "Schmierung: drückt alle so viele Umläufe";
/* Grüße aus Köln: in Latin-1, with the line ends and blanks of an editor of then */
pin in bit turn "eine Umdrehung";
pin out bit pump "Öl";
param rw s32 every = 0o2;
variable int turns;
variable bool before;
function _;
author "Jürgen Größ";
license "GPL";
  ;;  
if(turn && !before) turns++;
before = turn;
pump = turns > 0 && turns % every == 0;   // über Modulo