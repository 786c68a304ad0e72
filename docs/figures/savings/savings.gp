# Draws savings.csv: gnuplot savings.gp
set datafile separator ','
set key outside top center horizontal
set style fill solid 0.8
set grid x
set xrange [0:*]
set yrange [] reverse
set offsets 0, 0, 0.6, 0.6
set xlabel 'ns of one thread for a step of a grain with six contacts'
do for [form in "svg png"] {
    if (form eq "svg") { set terminal svg size 900,460 font 'DejaVu Sans,14' background 'white' } else { set terminal pngcairo size 1350,690 font 'DejaVu Sans,18' }
    set output 'savings.'.form
    plot 'savings.csv' every ::1 using 2:($0-0.18):(0):2:($0-0.36):($0):ytic(1) with boxxyerror lc rgb '#0072b2' title 'with', \
         '' every ::1 using 3:($0+0.18):(0):3:($0):($0+0.36) with boxxyerror lc rgb '#e69f00' title 'without'
}
