# mistakes of every kind, some caught
set ::out [open transcript w]
proc told {} {
    set texts {}
    foreach frame [winfo children .] {
        foreach message [winfo children $frame] {
            foreach part [winfo children $message] {
                if {[winfo class $part] eq "Label" && [string length [$part cget -text]] > 1} { lappend texts [$part cget -text] }
            }
        }
    }
    return $texts
}
proc try {label script} {
    puts $::out "$label: [catch {uplevel #0 $script} message] [string range $message 0 60]"
    flush $::out
}
puts $::out "the line before the mistake: [info exists ::before]"
dynamic_tab mine "My tab"
foreach {after label script} {
    500 "page twice" {dynamic_tab mine "My tab"}
    550 "no image" {load_image nosuch}
    600 "no number" {val2vel fast 1}
    650 "no words" {_ a b c}
    750 "an image" {expr {[image width [load_image run]] > 0}}
} { after $after [list try $label $script] }
after 900 { error "own mistake" }
after 950 { dynamic_tab mine "My tab" }
for {set i 1000} {$i < 2000} {incr i 50} { after $i { error "again and again" } }
after 2500 {
    puts $::out "questions: [winfo exists .bgerrorDialog] grab: [grab current .]"
    foreach text [lsearch -all -inline -not [told] Active*] { puts $::out "told: [string map [list \n { | }] $text]" }
    close $::out
    destroy .
}
