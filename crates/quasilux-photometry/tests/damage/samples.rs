//! Small undamaged files: each edition, symmetry and kind of record once.

/// LM-63 files.
pub(crate) fn ies() -> Vec<Vec<u8>> {
    let files = [
        "IESNA:LM-63-1995\n[TEST] tilt factors\n[MORE] twice\nTILT=INCLUDE\n1\n2\n0 90\n1 0.9\n\
         2 1500.0 1.0 5 3 1 1 -0.2 0.4 0\n1.0 1.0 36\n0 22.5 45 67.5 90\n0 45 90\n\
         100 90 70 40 0\n100 80 60 30 0\n100 70 50 20 0\n",
        "IESNA:LM-63-2002\r\n[TEST] absolute\r\n[TESTLAB] none\r\n[ISSUEDATE] 1-JAN-2000\r\n\
         [MANUFAC] nobody\r\nTILT=NONE\r\n1 -1 1 7 1 1 2 0.1 0.1 0\r\n1 1 10.5\r\n\
         0 15 30 45 60 75 90\r\n0\r\n1000.5 900 700.25 400 150 20 0\r\n",
        "a label\nanother label\nTILT=NONE\n1,1000,2.5,3,3,1,1,1,2,0\n0.9,0.95,30\n90,135,180\n\
         90,180,270\n10,20,30\n40,50,60\n70,80,90\nEND\n",
        "IES:LM-63-2019\n[TEST] upwards and downwards\nTILT=NONE\n1 500 1 5 5 1 2 -0.1 -0.1 0.05\n\
         1 1.1 12\n0 45 90 135 180\n0 90 180 270 360\n9 8 7 6 5\n9 7 5 3 1\n9 6 6 6 6\n\
         9 1 1 1 0\n9 8 7 6 5\n",
        "IESNA91\n[TEST] no closing plane\nTILT=NONE\n1 -1 1 3 4 1 2 0 0 0 1 1 10\n0 60 120\n\
         0 90 180 270\n5 4 3 5 3 2 5 2 1 5 6 7\n",
        "IESNA:LM-63-2002\n[TEST] type B\nTILT=NONE\n1 -1 1 5 3 2 2 0.1 0.1 0\n1 1 10\n\
         -90 -45 0 45 90\n-90 0 90\n0 1 2 1 0\n1 5 9 5 1\n0 1 2 1 0\n",
        "IESNA:LM-63-2002\n[TEST] type A\nTILT=lamp.tlt\n1 -1 1 3 3 3 2 0.1 0.1 0\n1 1 10\n\
         -30 0 30\n0 20 40\n1 9 1\n1 5 1\n0 1 0\n",
    ];
    files.map(|text| text.as_bytes().to_vec()).to_vec()
}

/// EULUMDAT files, one for each symmetry.
pub(crate) fn ldt() -> Vec<Vec<u8>> {
    let one_set = "1\n1\nT\n1000\n3000K\n80\n20";
    let two_sets = "2\n-1\nT\n1000\n-\n-\n20\n2\nT\n2000\n-\n-\n40";
    let files = [
        ("0", "90 0 90 180 270", "0.5", one_set, 4),
        ("1", "0 0", "100", one_set, 1),
        ("2", "45 0 45 90 135 180 225 270 315", "20,5", two_sets, 5),
        ("3", "0 0 30 90 180 270 330", "3", two_sets, 4),
        ("4", "90 0 90 180 270", "80.5", one_set, 2),
    ];
    let lines = |blanks: &str| blanks.replace(' ', "\n");
    let file = |(isym, planes, value, lamps, stored): (&str, &str, &str, &str, usize)| {
        let (distance, planes) = planes.split_once(' ').unwrap_or_default();
        let count = planes.split(' ').count();
        let luminaire = lines("1200 300 80 1100 200 10 20 10 20 100 80 1 0");
        let (ratios, planes) = (lines(&"0.5 ".repeat(10)), lines(planes));
        let intensities: String = (0..3 * stored).map(|i| format!("{value}{}\n", i % 7)).collect();
        format!(
            "Maker\n2\n{isym}\n{count}\n{distance}\n3\n0\nreport\nname\nnumber\nfile\ndate\n\
             {luminaire}\n{lamps}\n{ratios}{planes}\n0\n30\n90\n{intensities}"
        )
        .into_bytes()
    };
    files.into_iter().map(file).collect()
}

/// TM-33 files: several emitters on unlike grids, names of other writers, and type B.
pub(crate) fn tm33() -> Vec<Vec<u8>> {
    let intensities =
        |horizontal: &[u32], vertical: &[i32], [element, h, v]: [&str; 3]| -> String {
            let pairs =
                horizontal.iter().flat_map(|c| vertical.iter().map(move |gamma| (c, gamma)));
            pairs
                .enumerate()
                .map(|(i, (c, gamma))| {
                    format!("<{element} {h}=\"{c}\" {v}=\"{gamma}\">{}.5</{element}>\n", i % 9)
                })
                .collect()
        };
    let standard = ["IntData", "h", "v"];
    let emitter = |symmetry: &str, data: &str| {
        format!(
            "<Emitter><Description>LED &amp; lens</Description><Quantity>2</Quantity>\
             <RatedLumens>1000</RatedLumens><BallastFactor>0.9</BallastFactor>\
             <InputWattage>12</InputWattage><LuminousData><LuminousIntensity>\
             <AbsolutePhotometry>false</AbsolutePhotometry><Symm>{symmetry}</Symm>\
             <Multiplier>2</Multiplier><NumberHorz>2</NumberHorz><NumberVert>3</NumberVert>\n\
             {data}</LuminousIntensity></LuminousData></Emitter>\n"
        )
    };
    let file = |root: &str, emitters: String| {
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<{root}><Version>1.0</Version>\n<Header>\
             <Description>made up</Description><Laboratory>none</Laboratory></Header><Luminaire>\
             <Dimensions><Length>1.2</Length><Width>0.3</Width></Dimensions></Luminaire>\n\
             <!-- light --><Equipment/>{emitters}</{root}>\n"
        )
        .into_bytes()
    };
    let quarter = emitter("Symm_Quad", &intensities(&[0, 90], &[0, 45, 90], standard));
    let half = emitter("Symm_Bi0", &intensities(&[0, 60, 180], &[0, 30, 90], standard));
    let foreign = ["IntensityData", "horz", "vert"];
    let round = emitter("None", &intensities(&[0], &[0, 90, 180], foreign));
    vec![
        file("IESTM33-22", quarter.clone() + &half),
        file("IESTM33", quarter),
        file("ATLA_S001", round),
    ]
}
