//! Tables in the formats of other programs and spreadsheets have the same meaning as ours.

use crate::common::folder::Folder;

/// The modes of an R161, as this program, modal programs and European spreadsheets write them.
#[test]
fn measured_modes_are_read_however_they_are_written() {
    let folder = Folder::new("tables");
    let ours = "mode,frequency_hz,damping_percent\n1,174.51,0.6\n2,581.26,0.7\n3,1187.04,0.9\n4,1854.83,1.1\n";
    let pulse = "Mode,Frequency (Hz),Damping (%)\n1,174.51,0.60\n2,581.26,0.70\n3,1187.04,0.90\n4,1854.83,1.10\n";
    let european = "mode;frequency_hz;damping_percent\n1;174,51;0,60\n2;581,26;0,70\n3;1.187,04;0,90\n4;1.854,83;1,10\n";
    let wide = |text: &str, unit: fn(u16) -> [u8; 2], mark: [u8; 2]| -> Vec<u8> {
        mark.into_iter().chain(text.encode_utf16().flat_map(unit)).collect()
    };
    let quoted = "\"Mode\",\"FREQUENCY [Hz]\",\"Damping [%]\",\n\"1\",\"174,51\",\"0,6\",\n\"2\",\"581,26\",\"0,7\",\n,,,\n\"3\",\"1187,04\",\"0,9\",\n\"4\",\"1854,83\",\"1,1\",\n";
    let title = "Modal survey of an R161, 3 May\nOperator: N. N.; hammer 2\n\n";
    let columns = "Mode   Frequency (Hz)   Damping (%)\n1   174.51   0.60\n2   581.26   0.70\n3   1187.04   0.90\n4   1854.83   1.10\n";
    let western = b"Schl\xe4ger, 3.5.\nmode;frequency_hz;damping_percent\n1;174,51;0,60\n2;581,26;0,70\n3;1187,04;0,90\n4;1854,83;1,10\n";
    let files: [(&str, Vec<u8>); 13] = [
        ("titled.csv", format!("{title}{pulse}").into()),
        ("titled_european.csv", format!("Modes of R161;;\r\nDate;3.5.;\r\n{european}").into()),
        ("columns.txt", format!("{title}{columns}").into()),
        ("blanks.txt", columns.replace("   ", " ").into()),
        ("western.csv", western.to_vec()),
        ("ours.csv", ours.into()),
        ("pulse.csv", pulse.into()),
        ("european.csv", european.into()),
        ("told.csv", format!("sep=;\r\n{}", european.replace('\n', "\r\n")).into()),
        ("tabs.txt", pulse.replace(',', "\t").into()),
        ("wide.csv", wide(european, u16::to_le_bytes, [0xff, 0xfe])),
        ("wider.txt", wide(&pulse.replace(',', "\t"), u16::to_be_bytes, [0xfe, 0xff])),
        ("quoted.csv", quoted.into()),
    ];
    let mut known = None;
    for (name, text) in files {
        std::fs::write(folder.0.join(name), text).unwrap();
        let found = folder.json(&["calibrate", "r161", name, "--json", "-"]);
        assert_eq!(found["labels"]["taken"], serde_json::json!([1, 2, 3, 4]), "{name}");
        let parameters = known.get_or_insert_with(|| found["parameters"].clone());
        assert_eq!(&found["parameters"], parameters, "{name}");
        let compared = folder.json(&["compare", "r161", "--measured", name, "--json", "-"]);
        assert!(compared.to_string().contains("1854.83"), "{name}");
    }
}

/// Inches in sixteenths, a decimal comma and capitals: the profile is the same to the last bit.
#[test]
fn a_profile_is_read_however_its_table_is_written() {
    let folder = Folder::new("tables_profile");
    let bat = |table: &str| {
        format!(
            r#"{{ "format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile": {{ "csv": "{table}" }} }}"#
        )
    };
    for (name, text) in [
        ("ours.csv", "x_in,diameter_in\n0,1\n6.5,0.9375\n20.25,1.5\n33,2.5\n"),
        (
            "rule.csv",
            "Position (in);Outer diameter (in)\n0;1\n6 1/2;15/16\n20 1/4;1 1/2\n33;2 1/2\n",
        ),
        (
            "comma.txt",
            "X [IN]\tDiameter [in]\t\n0\t1\t\n6,5\t0,9375\t\n20,25\t1,5\t\n33\t2,5\t\n\t\t\n",
        ),
    ] {
        folder.write(name, text);
        folder.write(&format!("{name}.json"), bat(name));
    }
    let modes = |name: &str| {
        let args = ["modes", &format!("{name}.json"), "-n", "3", "--quiet", "--json", "-"];
        folder.json(&args)["modes"].clone()
    };
    assert_eq!(modes("rule.csv"), modes("ours.csv"));
    assert_eq!(modes("comma.txt"), modes("ours.csv"));
}

/// Channel lists of some programs make a long text above the header; a missing header is reported as such, and not the
/// short rows below.
#[test]
fn a_header_is_found_below_a_long_text_and_missed_where_there_is_none() {
    let folder = Folder::new("tables_long");
    let above: String =
        (0..75).map(|k| format!("Channel {k}, accelerometer, {k} mV/g\n")).collect();
    let rows = "1,174.51\n2,581.26\n3,1187.04\n";
    folder.write("long.csv", format!("{above}Mode,Frequency [Hz]\n{rows}"));
    let found = folder.json(&["calibrate", "r161", "long.csv", "--json", "-"]);
    assert_eq!(found["labels"]["taken"], serde_json::json!([1, 2, 3]));
    folder.write("none.csv", format!("{above}{rows}"));
    let error = folder.run(&["calibrate", "r161", "none.csv"]);
    let error = String::from_utf8_lossy(&error.stderr);
    assert!(error.contains("none.csv:1") && error.contains("mode"), "{error}");
    assert!(!error.contains("in this row"), "{error}");
}
